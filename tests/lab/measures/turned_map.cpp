#include "tests/lab/measures/turned_map.h"

#include "protocol/basis/cubemap.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>

namespace relume::lab {

using Imath::V3d;
using Imath::V3f;

namespace {

// A side of the cube in 1024 parts: finer than the maps that are turned.
constexpr std::uint32_t kPartsAlongTexel = 1024 / TurnedMap::kMeansResolution;

// Along a face, in [-1, 1].
float part_middle(std::uint32_t texel, std::uint32_t part) {
    const double middle = texel + (part + 0.5) / kPartsAlongTexel;
    return static_cast<float>(middle * 2 / TurnedMap::kMeansResolution - 1);
}

}  // namespace

const V3f& TexelLight::towards(const V3f& direction) const {
    return radiance[basis::index_from_texel(n, basis::texel_from_direction(n, direction))];
}

TurnedMap::TurnedMap(const light::EnvironmentMap& map, const Imath::Quatf& rotation)
    : map_(map),
      rotation_(rotation),
      source_from_world_(rotation.inverse()),
      means_{kMeansResolution, std::vector<V3f>(basis::texel_count(kMeansResolution))} {
    tbb::parallel_for(std::size_t{0}, means_.radiance.size(), [&](std::size_t i) {
        const basis::Texel texel = basis::texel_from_index(kMeansResolution, i);
        V3d sum(0);
        double weight_sum = 0;
        for (std::uint32_t part = 0; part < kPartsAlongTexel * kPartsAlongTexel; ++part) {
            const V3f point = basis::cube_point_from_face_point(
                {texel.face, part_middle(texel.column, part % kPartsAlongTexel),
                 part_middle(texel.row, part / kPartsAlongTexel)});
            const double weight = std::pow(V3d(point).length2(), -1.5);
            sum += weight * V3d(towards(point));
            weight_sum += weight;
        }
        means_.radiance[i] = V3f(sum / weight_sum);
    });
}

V3f TurnedMap::towards(const V3f& world_direction) const {
    return map_.radiance(source_from_world_.rotateVector(world_direction));
}

TexelLight TurnedMap::texel_means(std::uint32_t n) const {
    std::vector<V3d> energy(basis::texel_count(n), V3d(0));
    const std::uint32_t side = kMeansResolution / n;
    for (std::size_t i = 0; i < means_.radiance.size(); ++i) {
        const basis::Texel fine = basis::texel_from_index(kMeansResolution, i);
        const basis::Texel coarse{fine.face, fine.row / side, fine.column / side};
        energy[basis::index_from_texel(n, coarse)] +=
            V3d(means_.radiance[i]) *
            basis::solid_angle_sr(kMeansResolution, fine.row, fine.column);
    }
    TexelLight result{n, std::vector<V3f>(energy.size())};
    for (std::size_t i = 0; i < energy.size(); ++i) {
        const basis::Texel texel = basis::texel_from_index(n, i);
        result.radiance[i] = V3f(energy[i] / basis::solid_angle_sr(n, texel.row, texel.column));
    }
    return result;
}

}  // namespace relume::lab
