#include "precompute/bake/mesh/surface_caster.h"

#include "precompute/bake/base/error.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

namespace relume::bake {

// Embree's normal has the sense of the corners.
void SurfaceCaster::refuse_unseen(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const SurfaceCaster*>(arguments->geometryUserPtr);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        const float along =
            RTCHitN_Ng_x(arguments->hit, count, i) * RTCRayN_dir_x(arguments->ray, count, i) +
            RTCHitN_Ng_y(arguments->hit, count, i) * RTCRayN_dir_y(arguments->ray, count, i) +
            RTCHitN_Ng_z(arguments->hit, count, i) * RTCRayN_dir_z(arguments->ray, count, i);
        const std::uint32_t triangle = RTCHitN_primID(arguments->hit, count, i);
        if (arguments->valid[i] == 0) {
            continue;
        }
        const auto& cutout =
            self.materials_[self.surface_.mesh.triangles[triangle].material].cutout;
        if (along >= 0 ||
            (cutout && !transport::is_solid_at(self.surface_, *cutout, triangle,
                                               RTCHitN_u(arguments->hit, count, i),
                                               RTCHitN_v(arguments->hit, count, i)))) {
            arguments->valid[i] = 0;
        }
    }
}

SurfaceCaster::SurfaceCaster(const transport::Surface& surface,
                             const std::vector<transport::MaterialRecord>& materials)
    : surface_(surface), materials_(materials), device_(rtcNewDevice(nullptr)) {
    const transport::SurfaceMesh& mesh = surface.mesh;
    if (!device_) {
        throw BakeError(fmt::format("Embree gives no device (error {}), expected one",
                                    static_cast<int>(rtcGetDeviceError(nullptr))));
    }
    accelerator_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(accelerator_.get(), RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Imath::V3f), mesh.positions.size());
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (positions == nullptr || corners == nullptr) {
        rtcReleaseGeometry(geometry);
        throw BakeError(
            fmt::format("no memory for a surface of {} triangles", mesh.triangles.size()));
    }
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Imath::V3f));
    for (const transport::SurfaceTriangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle.vertices) {
            *corners++ = vertex;
        }
    }
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryIntersectFilterFunction(geometry, &SurfaceCaster::refuse_unseen);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(accelerator_.get(), geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(accelerator_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
        throw BakeError(fmt::format("Embree cannot build {} triangles: error {}",
                                    mesh.triangles.size(), static_cast<int>(error)));
    }
}

std::optional<SurfaceHit> SurfaceCaster::closest_hit(const Imath::V3f& origin,
                                                     const Imath::V3f& direction) const {
    RTCRayHit query{};
    query.ray.org_x = origin.x;
    query.ray.org_y = origin.y;
    query.ray.org_z = origin.z;
    query.ray.dir_x = direction.x;
    query.ray.dir_y = direction.y;
    query.ray.dir_z = direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(accelerator_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return SurfaceHit{.triangle = query.hit.primID, .barycentric = {query.hit.u, query.hit.v}};
}

}  // namespace relume::bake
