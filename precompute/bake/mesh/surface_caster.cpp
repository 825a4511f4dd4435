#include "precompute/bake/mesh/surface_caster.h"

#include "precompute/bake/base/error.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

namespace relume::bake {
namespace {

// Embree's normal has the sense of the corners.
void refuse_backs(const RTCFilterFunctionNArguments* arguments) {
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        const float along =
            RTCHitN_Ng_x(arguments->hit, count, i) * RTCRayN_dir_x(arguments->ray, count, i) +
            RTCHitN_Ng_y(arguments->hit, count, i) * RTCRayN_dir_y(arguments->ray, count, i) +
            RTCHitN_Ng_z(arguments->hit, count, i) * RTCRayN_dir_z(arguments->ray, count, i);
        if (along >= 0) {
            arguments->valid[i] = 0;
        }
    }
}

}  // namespace

SurfaceCaster::SurfaceCaster(const transport::SurfaceMesh& mesh)
    : device_(rtcNewDevice(nullptr)) {
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
    rtcSetGeometryIntersectFilterFunction(geometry, &refuse_backs);
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
