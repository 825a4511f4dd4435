#include "tests/stability/triple/lit_point.h"

#include "precompute/materials/field_baker.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/visibility_field.h"
#include "protocol/tripling/texel_blocks.h"

namespace relume::stability {

LitPoint::LitPoint(std::uint32_t n, const Imath::V3f& normal, const IsOpen& is_open)
    : n_(n), normal_(normal), visibility_(basis::texel_count(n)) {
    std::vector<std::uint64_t> bits(transport::words_of_visibility(n));
    for (std::size_t texel = 0; texel < visibility_.size(); ++texel) {
        const Imath::V3f direction =
            basis::direction_from_texel(n, basis::texel_from_index(n, texel));
        if (direction.dot(normal) > 0 && is_open(direction)) {
            visibility_[texel] = 1;
            bits[texel / 64] |= std::uint64_t{1} << texel % 64;
        }
    }
    open_.resize(bits.size());
    tripling::bits_in_blocks(n, bits, open_);
}

double LitPoint::shown(const triple::TexelMaterial& material,
                       const light::LightCubemap& light,
                       const Imath::V3f& reflection) const {
    const std::vector<float> red = tripling::values_in_blocks(n_, light.planes()[0]);
    return double{material.radiance(normal_, reflection, open_,
                                    {red.data(), red.data(), red.data()},
                                    material.colours())[0]};
}

double LitPoint::by_model(const materials::FieldModel& model,
                          const materials::TexelSamples& samples,
                          const light::LightCubemap& light,
                          const Imath::V3f& reflection) const {
    const auto lobes = materials::lobe_texels(model, samples, normal_, reflection);
    double sum = 0;
    for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe) {
        for (std::size_t texel = 0; texel < visibility_.size(); ++texel) {
            sum += double{model.colours[lobe].x} * double{lobes[lobe][texel]} *
                   double{visibility_[texel]} * double{light.planes()[0][texel]};
        }
    }
    return sum;
}

triple::TexelMaterial texel_material(const materials::FieldModel& model,
                                     std::uint32_t face_resolution,
                                     std::uint32_t normal_side,
                                     std::uint32_t reflection_side,
                                     std::uint32_t samples_per_side) {
    materials::FieldReport report;
    return triple::TexelMaterial(materials::bake_field(model,
                                                       {.face_resolution = face_resolution,
                                                        .normal_side = normal_side,
                                                        .reflection_side = reflection_side,
                                                        .energy_fraction = 1,
                                                        .samples_per_side = samples_per_side},
                                                       report));
}

}  // namespace relume::stability
