// Measures what quantisation does to the image, under lights of the two kinds of light_model.h,
// while the float rows are at hand: in 2×2 pixels of every tile, so that the error of the
// image's gradient is seen too.
#pragma once

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/pilot.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Sums over pixels and lights, of one kind of light.
struct ErrorSums {
    double error = 0;           // Σ (B̃ − B)²
    double value = 0;           // Σ B²
    double gradient_error = 0;  // Σ |∇(B̃ − B)|²
    double gradient = 0;        // Σ |∇B|²

    void add(const ErrorSums& other);
};

enum LightKind : std::uint8_t { kNatural, kSun, kLightKinds };
using BlockErrors = std::array<ErrorSums, kLightKinds>;

class ErrorMeter {
  public:
    ErrorMeter(const basis::CubemapProjection& projection, const Quantisation& quantisation);

    static constexpr std::size_t kLightsPerKind = 4;
    // B and B̃ of a pixel under every light, in red, green and blue.
    struct PixelLight {
        std::array<std::array<double, 3>, kLightKinds * kLightsPerKind> exact{};
        std::array<std::array<double, 3>, kLightKinds * kLightsPerKind> stored{};
    };
    void measure_exact(const CoefficientRow& exact, PixelLight& light) const;
    // `stored` is the pixel's row as stored, [K][N].
    void measure_stored(std::span<const float> stored,
                        const Imath::V3f& tint,
                        PixelLight& light) const;

    // Of the four measured pixels of a tile: upper left, upper right, lower left, lower right.
    [[nodiscard]] static BlockErrors errors(const std::array<PixelLight, 4>& pixels);

  private:
    const Quantisation& quantisation_;
    std::vector<std::vector<float>> lights_;
};

// {"natural": {"relative_l2", "relative_h1"}, "sun": {…}}; h1 is of the gradient alone.
[[nodiscard]] nlohmann::json json_from_errors(std::span<const BlockErrors> blocks);

}  // namespace relume::bake
