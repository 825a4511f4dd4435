// A point whose light, visibility and material are multiplied: as the server sums them, and by
// plain sums.
#pragma once

#include "precompute/materials/field_model.h"
#include "precompute/materials/texel_samples.h"
#include "protocol/light/light_cubemap.h"
#include "server/triple/texel_material.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace relume::stability {

class LitPoint {
  public:
    using IsOpen = std::function<bool(const Imath::V3f& direction)>;

    // Sees the texels of 6·n² whose middle lies above its normal and is open.
    LitPoint(std::uint32_t n, const Imath::V3f& normal, const IsOpen& is_open);

    [[nodiscard]] const Imath::V3f& normal() const { return normal_; }
    // [6·n²], 0 or 1, in the order of cubemap.h.
    [[nodiscard]] const std::vector<float>& visibility() const { return visibility_; }
    // Red of what is sent to a viewer in this mirrored direction: the server's sum.
    [[nodiscard]] double shown(const triple::TexelMaterial& material,
                               const light::LightCubemap& light,
                               const Imath::V3f& reflection) const;
    // The same by the material itself, not tabulated, in double precision.
    [[nodiscard]] double by_model(const materials::FieldModel& model,
                                  const materials::TexelSamples& samples,
                                  const light::LightCubemap& light,
                                  const Imath::V3f& reflection) const;

  private:
    std::uint32_t n_;
    Imath::V3f normal_;
    std::vector<float> visibility_;
    std::vector<std::uint64_t> open_;  // in squares
};

// All of its energy, in texels.
[[nodiscard]] triple::TexelMaterial texel_material(const materials::FieldModel& model,
                                                   std::uint32_t face_resolution,
                                                   std::uint32_t normal_side,
                                                   std::uint32_t reflection_side,
                                                   std::uint32_t samples_per_side);

}  // namespace relume::stability
