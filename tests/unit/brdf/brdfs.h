// A factored BRDF of random tables.
#pragma once

#include "protocol/brdf/factored_brdf.h"

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace relume::brdf {

inline DirectionTable random_table(const TableShape& shape, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::vector<float> values(shape.value_count());
    for (float& value : values) {
        value = normal(random);
    }
    return {shape, std::move(values)};
}

inline FactoredBrdf random_brdf(std::string name, std::uint32_t terms, std::uint32_t lobes) {
    return {.name = std::move(name),
            .terms = terms,
            .lobes = lobes,
            .g = random_table({.rows = 5, .columns = 8, .depth = terms}, 1),
            .h = random_table({.rows = 4, .columns = 6, .depth = terms * lobes}, 2)};
}

}  // namespace relume::brdf
