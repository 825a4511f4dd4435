#include "protocol/brdf/local_frame.h"

#include "protocol/basis/cpu_clones.h"

namespace relume::brdf {
namespace {

// Plain pointers: what a span's operator[] reads again each time would not vectorise.
RELUME_CPU_CLONES void turn(const float* nx,
                            const float* ny,
                            const float* nz,
                            const float* dx,
                            const float* dy,
                            const float* dz,
                            float* __restrict x,
                            float* __restrict y,
                            float* __restrict z,
                            std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const Frame frame = local_frame({nx[i], ny[i], nz[i]});
        const Imath::V3f local = frame.local_from_world({dx[i], dy[i], dz[i]});
        x[i] = local.x;
        y[i] = local.y;
        z[i] = local.z;
    }
}

}  // namespace

void local_from_world(const Directions& normals,
                      const Directions& directions,
                      const DirectionPlanes& out) {
    turn(normals.x.data(), normals.y.data(), normals.z.data(), directions.x.data(),
         directions.y.data(), directions.z.data(), out.x.data(), out.y.data(), out.z.data(),
         normals.size());
}

}  // namespace relume::brdf
