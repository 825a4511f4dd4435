#include "precompute/bake/rays/ray_caster.h"

#include "precompute/bake/base/error.h"
#include "protocol/basis/cpu_clones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace relume::bake {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

RTCRay make_ray(const Imath::V3f& origin, const Imath::V3f& direction) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = kInfinity;
    ray.mask = ~0U;
    return ray;
}

RTCIntersectContext make_context(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

RELUME_CPU_CLONES void select_lanes(std::uint32_t wanted, int* valid, float* tfar) {
    for (std::uint32_t i = 0; i < kPacketSize; ++i) {
        valid[i] = -static_cast<int>((wanted >> i) & 1U);
        tfar[i] = kInfinity;
    }
}

// Embree sets the far end of a ray that meets something to minus infinity.
RELUME_CPU_CLONES std::uint32_t positive_lanes(const float* tfar) {
    std::uint32_t lanes = 0;
    for (std::uint32_t i = 0; i < kPacketSize; ++i) {
        lanes += tfar[i] > 0 ? 1U << i : 0U;
    }
    return lanes;
}

std::array<Imath::V3f, kPacketSize> all_at(const Imath::V3f& origin) {
    std::array<Imath::V3f, kPacketSize> origins;
    origins.fill(origin);
    return origins;
}

}  // namespace

RayCaster::RayCaster(const scene::Scene& scene)
    : scene_(&scene), device_(rtcNewDevice(nullptr)) {
    if (!device_) {
        throw BakeError(fmt::format("Embree gives no device (error {}), expected one",
                                    static_cast<int>(rtcGetDeviceError(nullptr))));
    }
    accelerator_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(accelerator_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(accelerator_.get(), RTC_BUILD_QUALITY_HIGH);
    contexts_.reserve(scene.meshes.size());
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
        contexts_.push_back({scene_, i});
    }
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
        attach(scene.meshes[i], i);
    }
    rtcCommitScene(accelerator_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
        throw BakeError(fmt::format("Embree cannot build {} triangles: error {}",
                                    scene.triangle_count(), static_cast<int>(error)));
    }
}

void RayCaster::attach(const scene::Mesh& mesh, std::uint32_t index) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Imath::V3f), mesh.positions.size());
    void* triangles =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(scene::Triangle), mesh.triangles.size());
    if (positions == nullptr || triangles == nullptr) {
        rtcReleaseGeometry(geometry);
        throw BakeError(fmt::format("no memory for mesh '{}' of {} triangles", mesh.name,
                                    mesh.triangles.size()));
    }
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Imath::V3f));
    std::memcpy(triangles, mesh.triangles.data(),
                mesh.triangles.size() * sizeof(scene::Triangle));
    if (scene_->materials[mesh.material].has_holes()) {
        rtcSetGeometryUserData(geometry, &contexts_[index]);
        rtcSetGeometryIntersectFilterFunction(geometry, &RayCaster::pass_holes);
        rtcSetGeometryOccludedFilterFunction(geometry, &RayCaster::pass_holes);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(accelerator_.get(), geometry, index);
    rtcReleaseGeometry(geometry);
}

void RayCaster::pass_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto* context = static_cast<const MeshContext*>(arguments->geometryUserPtr);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const Imath::V2f barycentric{RTCHitN_u(arguments->hit, count, i),
                                     RTCHitN_v(arguments->hit, count, i)};
        if (!scene::is_solid_at(*context->scene, context->mesh,
                                RTCHitN_primID(arguments->hit, count, i), barycentric)) {
            arguments->valid[i] = 0;
        }
    }
}

std::optional<Hit> RayCaster::closest_hit(const Imath::V3f& origin,
                                          const Imath::V3f& direction) const {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context = make_context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcIntersect1(accelerator_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return Hit{.mesh = query.hit.geomID,
               .triangle = query.hit.primID,
               .barycentric = {query.hit.u, query.hit.v},
               .distance = query.ray.tfar};
}

bool RayCaster::is_occluded(const Imath::V3f& origin, const Imath::V3f& direction) const {
    RTCRay ray = make_ray(origin, direction);
    RTCIntersectContext context = make_context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded1(accelerator_.get(), &context, &ray);
    return ray.tfar < 0;
}

RayPacket::RayPacket(const Imath::V3f& origin) : RayPacket(all_at(origin)) {}

RayPacket::RayPacket(const std::array<Imath::V3f, kPacketSize>& origins)
    : context_(make_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT)) {
    for (std::size_t i = 0; i < kPacketSize; ++i) {
        rays_.org_x[i] = origins[i].x;
        rays_.org_y[i] = origins[i].y;
        rays_.org_z[i] = origins[i].z;
        rays_.dir_x[i] = rays_.dir_y[i] = rays_.dir_z[i] = 0;
        rays_.tnear[i] = 0;
        rays_.time[i] = 0;
        rays_.mask[i] = ~0U;
        rays_.id[i] = 0;
        rays_.flags[i] = 0;
    }
}

std::uint32_t RayCaster::unoccluded(RayPacket& packet, std::uint32_t wanted) const {
    select_lanes(wanted, packet.valid_.data(), packet.rays_.tfar);
    rtcOccluded16(packet.valid_.data(), accelerator_.get(), &packet.context_, &packet.rays_);
    return positive_lanes(packet.rays_.tfar) & wanted;
}

Imath::V3f offset_origin(const scene::SurfacePoint& point) {
    return point.position + point.reach * 0x1p-19F * point.geometric_normal;
}

}  // namespace relume::bake
