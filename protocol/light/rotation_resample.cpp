#include "protocol/light/rotation_resample.h"

#include "protocol/basis/cubemap.h"
#include "protocol/light/resample_kernel.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace relume::light {
namespace {

ResampleFaces make_faces(const Imath::Quatf& rotation) {
    const Imath::Quatf source_from_world = rotation.normalized().inverse();
    ResampleFaces faces{};
    for (std::uint32_t f = 0; f < basis::kFaceCount; ++f) {
        const auto face = static_cast<basis::Face>(f);
        const Imath::V3f normal = basis::cube_point_from_face_point({face, 0, 0});
        const Imath::V3f u_axis = basis::cube_point_from_face_point({face, 1, 0}) - normal;
        const Imath::V3f v_axis = basis::cube_point_from_face_point({face, 0, 1}) - normal;
        faces[f] = {source_from_world.rotateVector(normal),
                    source_from_world.rotateVector(u_axis),
                    source_from_world.rotateVector(v_axis)};
    }
    return faces;
}

}  // namespace

void resample(const PrefilteredEnvironment& environment,
              const Imath::Quatf& rotation,
              const Imath::V3f& scale,
              Write write,
              LightCubemap& out) {
    const std::uint32_t n = out.face_resolution;
    if (n != environment.face_resolution()) {
        throw std::invalid_argument(
            fmt::format("environment is prefiltered for face resolution {}, the cubemap has {}",
                        environment.face_resolution(), n));
    }
    // Not a number would become an index out of bounds further down.
    if (!(rotation.length() > 0 && std::isfinite(rotation.length()))) {
        throw std::invalid_argument("rotation is not a quaternion of finite, non-zero length");
    }
    const ResampleJob job{
        .texels = environment.padded_texels().data(),
        .inner_resolution = environment.inner_resolution(),
        .face_resolution = n,
        .faces = make_faces(rotation),
        .scale = scale,
        .accumulate = write == Write::accumulate,
        .out = out.radiance.data(),
    };
    // Rows of small cubemaps are too short to be worth a task each.
    const std::size_t grain = std::max<std::size_t>(1, 64 / n);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, grain), [&](const auto& range) {
        for (std::uint32_t row = range.begin(); row != range.end(); ++row) {
            resample_row(job, row);
        }
    });
}

}  // namespace relume::light
