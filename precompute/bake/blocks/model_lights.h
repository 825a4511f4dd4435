// The lights of light_model.h, a few of each kind, and what a row answers to them.
#pragma once

#include "precompute/bake/rows/row_baker.h"
#include "protocol/basis/cubemap_projection.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

enum LightKind : std::uint8_t { kNatural, kSun, kLightKinds };
inline constexpr std::size_t kLightsPerKind = 4;
inline constexpr std::size_t kModelLights = kLightKinds * kLightsPerKind;

// A receiver in red, green and blue under every light: those of natural light, then the suns.
using LitColours = std::array<std::array<double, 3>, kModelLights>;

class ModelLights {
  public:
    explicit ModelLights(const basis::CubemapProjection& projection);

    // T·L of one row of N coefficients, under every light.
    [[nodiscard]] std::array<double, kModelLights> products(std::span<const float> row) const;
    [[nodiscard]] LitColours colours(const CoefficientRow& row) const;

  private:
    struct Light {
        std::vector<float> coefficients;  // N values, or none where `terms` are few
        std::vector<basis::CubemapBasis::Term> terms;
    };
    std::vector<Light> lights_;
};

}  // namespace relume::bake
