// A material field as sums over open texels read it.
#pragma once

#include "protocol/tripling/direction_grid.h"
#include "protocol/tripling/material_field.h"
#include "protocol/tripling/texel_store.h"
#include "server/engine/kernels/open_mixture.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::triple {

using Radiance = std::array<float, 3>;

// Immutable; safe to share between threads.
class TexelMaterial {
  public:
    // All that the field's wavelets hold, entry by entry back in texels, in parallel, but for
    // runs of texels that are kLeftOff of an entry's sum together.
    explicit TexelMaterial(const tripling::MaterialField& field);
    static constexpr double kLeftOff = 1e-4;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::uint32_t face_resolution() const {
        return lobes_.front().face_resolution();
    }
    [[nodiscard]] std::size_t lobe_count() const { return lobes_.size(); }
    // As the file has them.
    [[nodiscard]] const std::vector<Imath::V3f>& colours() const { return colours_; }
    [[nodiscard]] bool depends_on_view() const { return reflections_.side() > 1; }
    [[nodiscard]] std::size_t byte_count() const;

    // What a vertex sends to a viewer: Σ over open texels of light times Σ_l colour_l·lobe_l.
    // `colours`: [lobe_count()]; `planes` and `open` in squares (tripling/texel_blocks.h).
    [[nodiscard]] Radiance radiance(const Imath::V3f& normal,
                                    const Imath::V3f& reflection,
                                    std::span<const std::uint64_t> open,
                                    const engine::ColourPlanes& planes,
                                    std::span<const Imath::V3f> colours) const;

  private:
    std::string name_;
    tripling::DirectionGrid normals_;
    tripling::DirectionGrid reflections_;
    std::vector<tripling::TexelStore> lobes_;
    std::vector<Imath::V3f> colours_;
};

}  // namespace relume::triple
