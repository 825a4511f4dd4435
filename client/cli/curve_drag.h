// Strokes that somebody draws over the curves of a scene's materials, at random, as load.
#pragma once

#include "protocol/wire/editable_material.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace relume::cli {

// Draws one stroke in `kEditsPerStroke` edits, from left to right, as a hand does; then another
// one, of another material perhaps. Values stay near those of the curve as baked.
class CurveDrag {
  public:
    static constexpr std::uint32_t kEditsPerStroke = 20;

    // At least one material. The same seed draws the same strokes.
    CurveDrag(std::vector<wire::EditableMaterial> materials, std::uint64_t seed);

    // The next edit, a patch.
    [[nodiscard]] nlohmann::json next();

  private:
    void begin_stroke();

    std::vector<wire::EditableMaterial> materials_;
    std::mt19937_64 random_;
    std::uint32_t edits_ = 0;   // of this stroke
    std::size_t material_ = 0;  // that it is of
    std::uint32_t first_ = 0;   // sample where it begins
    std::uint32_t count_ = 0;   // samples that it covers at its end
    double factor_ = 1;         // times the curve as baked, in its middle
};

}  // namespace relume::cli
