#include "precompute/bake/blocks/model_lights.h"

#include "precompute/bake/blocks/light_model.h"

#include <numeric>
#include <utility>

namespace relume::bake {
namespace {

double dense_product(std::span<const float> a, std::span<const float> b) {
    // Sums side by side, which the compiler makes one vector.
    constexpr std::size_t kLanes = 8;
    std::array<double, kLanes> sums{};
    std::size_t j = 0;
    for (; j + kLanes <= a.size(); j += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            sums[lane] += double{a[j + lane]} * double{b[j + lane]};
        }
    }
    double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    for (; j < a.size(); ++j) {
        sum += double{a[j]} * double{b[j]};
    }
    return sum;
}

}  // namespace

ModelLights::ModelLights(const basis::CubemapProjection& projection) {
    const auto add = [this](std::vector<float> coefficients) {
        Light light;
        for (std::size_t j = 0; j < coefficients.size(); ++j) {
            if (coefficients[j] != 0) {
                light.terms.push_back({static_cast<std::uint32_t>(j), coefficients[j]});
            }
        }
        constexpr std::size_t kFewest = 16;  // of which one is a term, lest they cost more
        if (light.terms.size() * kFewest > coefficients.size()) {
            light.terms.clear();
            light.coefficients = std::move(coefficients);
        }
        lights_.push_back(std::move(light));
    };
    for (std::uint64_t i = 0; i < kLightsPerKind; ++i) {
        add(natural_light(projection.basis(), i));
    }
    for (std::uint64_t i = 0; i < kLightsPerKind; ++i) {
        add(sun_light(projection, i));
    }
}

std::array<double, kModelLights> ModelLights::products(std::span<const float> row) const {
    std::array<double, kModelLights> values{};
    for (std::size_t i = 0; i < kModelLights; ++i) {
        const Light& light = lights_[i];
        if (!light.coefficients.empty()) {
            values[i] = dense_product(row, light.coefficients);
        }
        for (const auto& [index, value] : light.terms) {
            values[i] += double{row[index]} * double{value};
        }
    }
    return values;
}

LitColours ModelLights::colours(const CoefficientRow& row) const {
    LitColours lit;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<double, kModelLights> products_of_row = products(row.rgb[c]);
        for (std::size_t i = 0; i < kModelLights; ++i) {
            lit[i][c] = products_of_row[i];
        }
    }
    return lit;
}

}  // namespace relume::bake
