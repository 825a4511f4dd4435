// Columns of a tile multiplied with a curve.
#include "server/materials/tile_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace relume::materials {
namespace {

struct Product {
    ColumnValues values;
    curve::Curve curve;
    Imath::V3f diffuse;
};

// Columns of very different sizes, as narrow highlights make them, some of them empty.
Product random_product(std::size_t pixels, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    Product product{.values = ColumnValues(pixels),
                    .curve = {},
                    .diffuse = {3 * uniform(random), uniform(random), 0}};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
            const float size = k % 7 == 0 ? 0.0F : std::pow(10.0F, 4 * uniform(random) - 3);
            for (std::size_t i = 0; i < pixels; ++i) {
                product.values.column(c, k)[i] = size * uniform(random);
            }
            product.curve.rgb[c][k] = k % 5 == 0 ? 0.0F : 9 * uniform(random);
        }
    }
    for (std::size_t i = 0; i < 3 * pixels; ++i) {
        product.values.diffuse[i] = uniform(random);
        product.values.baked[i] = uniform(random);
    }
    return product;
}

std::vector<std::uint8_t> first_slots(std::size_t count) {
    std::vector<std::uint8_t> slots(count);
    std::iota(slots.begin(), slots.end(), std::uint8_t{0});
    return slots;
}

TEST(TileColumns, ChangeIsTheProductOfAllColumns) {
    for (const std::size_t pixels : {1U, 2U, 31U, 256U}) {
        Product product = random_product(pixels, pixels);
        const TileColumns columns(first_slots(pixels), product.values);
        std::vector<float> rgb(3 * pixels);
        columns.change(product.curve, product.diffuse, rgb);
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at = c * pixels + i;
                double expected = double{product.diffuse[static_cast<int>(c)] - 1} *
                                      double{product.values.diffuse[at]} -
                                  double{product.values.baked[at]};
                double bound = 1e-5;
                for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
                    const float* const column = product.values.column(c, k);
                    const double value{product.curve.rgb[c][k]};
                    expected += value * double{column[i]};
                    double most = 0;
                    for (std::size_t j = 0; j < pixels; ++j) {
                        most = std::max(most, double{column[j]});
                    }
                    bound += value * most / 65534 * 1.001 + 1e-6 * value * most;
                }
                EXPECT_NEAR(rgb[3 * i + c], expected, bound) << pixels << " " << i;
            }
        }
    }
}

TEST(TileColumns, WhatNoCurveMeetsIsTheBakesTakenAway) {
    Product product = random_product(5, 3);
    const TileColumns columns(first_slots(5), product.values);
    std::vector<float> rgb(15);
    columns.change(curve::Curve{}, Imath::V3f(1, 1, 1), rgb);
    for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(rgb[3 * i + c], -product.values.baked[c * 5 + i]);
        }
    }
}

TEST(TileColumns, BytesAreTwoAValueAndLittleMore) {
    const TileColumns columns(first_slots(256), ColumnValues(256));
    EXPECT_GE(columns.bytes(), std::size_t{2} * 3 * 256 * 256);
    EXPECT_LT(columns.bytes(), std::size_t{21} * 3 * 256 * 256 / 10);
}

}  // namespace
}  // namespace relume::materials
