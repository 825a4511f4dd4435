// Measures what quantisation does to the image, under lights of the two kinds of light_model.h,
// while the float rows are at hand: in a patch of neighbours of every block, so that the error
// of the image's gradient is seen too.
#pragma once

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/pilot.h"
#include "precompute/bake/receivers/receivers.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Sums over receivers and lights, of one kind of light.
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
    // B and B̃ of a receiver under every light, in red, green and blue.
    struct LitReceiver {
        std::array<std::array<double, 3>, kLightKinds * kLightsPerKind> exact{};
        std::array<std::array<double, 3>, kLightKinds * kLightsPerKind> stored{};
    };
    void measure_exact(const CoefficientRow& exact, LitReceiver& light) const;
    // `stored` is the receiver's row as stored, [K][N].
    void measure_stored(std::span<const float> stored,
                        const Imath::V3f& tint,
                        LitReceiver& light) const;

    // Of the slots of a patch; those without a row are black.
    [[nodiscard]] static BlockErrors errors(const BlockPatch& patch,
                                            std::span<const LitReceiver> lit);

  private:
    const Quantisation& quantisation_;
    std::vector<std::vector<float>> lights_;
};

// {"natural": {"relative_l2", "relative_h1"}, "sun": {…}}; h1 is of the gradient alone.
[[nodiscard]] nlohmann::json json_from_errors(std::span<const BlockErrors> blocks);

}  // namespace relume::bake
