// Measures what quantisation does to the image, under lights of the two kinds of light_model.h,
// while the float rows are at hand: in a patch of neighbours of every block, so that the error
// of the image's gradient is seen too.
#pragma once

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/model_signals.h"
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

using BlockErrors = std::array<ErrorSums, kSignalKinds>;

class ErrorMeter {
  public:
    // Keeps references to both.
    ErrorMeter(const ModelSignals& lights, const Quantisation& quantisation)
        : lights_(lights), quantisation_(quantisation) {}

    // B and B̃ of a receiver under every light, in red, green and blue.
    struct LitReceiver {
        LitColours exact{};
        LitColours stored{};
    };
    // `stored` is the receiver's row as stored, [K][N]. Fills light.stored.
    void measure_stored(std::span<const float> stored,
                        const Imath::V3f& tint,
                        LitReceiver& light) const;

    // Of the slots of a patch; those without a row are black.
    [[nodiscard]] static BlockErrors errors(const ClusterPatch& patch,
                                            std::span<const LitReceiver> lit);

  private:
    const ModelSignals& lights_;
    const Quantisation& quantisation_;
};

// {"natural": {"relative_l2", "relative_h1"}, "sun": {…}}; h1 is of the gradient alone.
[[nodiscard]] nlohmann::json json_from_errors(std::span<const BlockErrors> blocks);

}  // namespace relume::bake
