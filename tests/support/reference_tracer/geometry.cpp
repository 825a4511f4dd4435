#include "tests/support/reference_tracer/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace relume::reference {
namespace {

using Imath::V2d;
using Imath::V3d;

Imath::V3f single(const V3d& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

RTCRayHit ray_of(const V3d& origin, const V3d& direction, double near) {
    RTCRayHit ray{};
    const Imath::V3f o = single(origin);
    const Imath::V3f d = single(direction);
    ray.ray.org_x = o.x;
    ray.ray.org_y = o.y;
    ray.ray.org_z = o.z;
    ray.ray.dir_x = d.x;
    ray.ray.dir_y = d.y;
    ray.ray.dir_z = d.z;
    ray.ray.tnear = static_cast<float>(near);
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

template <typename Value>
auto blend(const std::vector<Value>& values, const scene::Triangle& t, double b1, double b2) {
    using Double = std::conditional_t<sizeof(Value) == sizeof(Imath::V2f), V2d, V3d>;
    return Double(values[t[0]]) * (1.0 - b1 - b2) + Double(values[t[1]]) * b1 +
           Double(values[t[2]]) * b2;
}

V3d rgb(const Imath::V4f& v) {
    return {v.x, v.y, v.z};
}

V3d unit_range(V3d c) {
    for (int i = 0; i < 3; ++i)
        c[i] = std::clamp(c[i], 0.0, 1.0);
    return c;
}

Reflection reflection_of(const scene::Scene& scene,
                         const scene::Material& material,
                         const Imath::V2f& uv,
                         const V3d& vertex_colour) {
    V3d base = V3d(material.base_colour) * vertex_colour;
    if (material.base_texture)
        base *= rgb(scene.textures[material.base_texture->texture].evaluate(uv));
    base = unit_range(base);
    Reflection reflection;
    if (material.model == scene::BsdfModel::lambert) {
        reflection.diffuse = base;
    } else if (material.model == scene::BsdfModel::phong) {
        reflection.model = Reflection::Model::phong;
        const V3d ks = unit_range(V3d(material.specular));
        const V3d sum = base + ks;
        const double excess = std::max({1.0, sum.x, sum.y, sum.z});
        reflection.diffuse = base / excess;
        reflection.specular = ks / excess;
        reflection.exponent = std::round(material.exponent * 16.0) / 16.0;
    } else {
        reflection.model = Reflection::Model::ggx;
        double metallic = material.metallic;
        double roughness = material.roughness;
        if (material.surface_texture) {
            const Imath::V4f surface =
                scene.textures[material.surface_texture->texture].evaluate(uv);
            roughness *= surface.y;
            metallic *= surface.z;
        }
        roughness = std::clamp(roughness, 0.05, 1.0);
        reflection.alpha = roughness * roughness;
        reflection.diffuse = base * (1.0 - metallic);
        const V3d f0 = V3d(material.dielectric_f0) * double{material.dielectric_f90};
        reflection.specular = f0 * (1.0 - metallic) + base * metallic;
        reflection.grazing = material.dielectric_f90 * (1.0 - metallic) + metallic;
        reflection.coat_f0 = std::max({f0.x, f0.y, f0.z});
        reflection.coat_f90 = material.dielectric_f90;
    }
    return reflection;
}

}  // namespace

Geometry::Geometry(const scene::Scene& scene)
    : scene_(scene), device_(rtcNewDevice(nullptr)), tree_(rtcNewScene(device_.get())) {
    rtcSetSceneFlags(tree_.get(), RTC_SCENE_FLAG_ROBUST);
    for (const scene::Mesh& mesh : scene.meshes) {
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(Imath::V3f), mesh.positions.size());
        std::memcpy(vertices, mesh.positions.data(),
                    mesh.positions.size() * sizeof(Imath::V3f));
        void* indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof(scene::Triangle), mesh.triangles.size());
        std::memcpy(indices, mesh.triangles.data(),
                    mesh.triangles.size() * sizeof(scene::Triangle));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree_.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(tree_.get());
}

std::optional<Geometry::Hit> Geometry::solid_hit(const V3d& origin,
                                                 const V3d& direction) const {
    double near = 0;
    while (true) {
        RTCRayHit ray = ray_of(origin, direction, near);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(tree_.get(), &context, &ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return std::nullopt;
        const Hit hit{ray.hit.geomID, ray.hit.primID, double{ray.hit.u}, double{ray.hit.v}};
        const scene::Mesh& mesh = scene_.meshes[hit.mesh];
        const scene::Material& material = scene_.materials[mesh.material];
        if (!material.alpha_cutoff)
            return hit;
        const V2d uv = mesh.uvs.empty()
                           ? V2d(0, 0)
                           : blend(mesh.uvs, mesh.triangles[hit.triangle], hit.b1, hit.b2);
        double alpha = material.opacity;
        if (material.base_texture)
            alpha *= scene_.textures[material.base_texture->texture].evaluate(Imath::V2f(uv)).w;
        if (alpha >= *material.alpha_cutoff)
            return hit;
        near = double{ray.ray.tfar} * (1.0 + 1e-6) + 1e-9;
    }
}

Surface Geometry::surface_at(const Hit& hit, const V3d& direction) const {
    const scene::Mesh& mesh = scene_.meshes[hit.mesh];
    const scene::Triangle& triangle = mesh.triangles[hit.triangle];
    const V3d p0(mesh.positions[triangle[0]]);
    const V3d p1(mesh.positions[triangle[1]]);
    const V3d p2(mesh.positions[triangle[2]]);
    const V3d to_viewer = -direction;
    Surface surface;
    surface.position = blend(mesh.positions, triangle, hit.b1, hit.b2);
    surface.face_normal = (p1 - p0).cross(p2 - p0).normalized();
    if (surface.face_normal.dot(to_viewer) < 0)
        surface.face_normal *= -1.0;
    V3d normal = surface.face_normal;
    if (!mesh.normals.empty())
        normal = blend(mesh.normals, triangle, hit.b1, hit.b2).normalized();
    if (normal.dot(surface.face_normal) < 0)
        normal *= -1.0;
    // The contract of scene::surface_point: the viewer ends up a thousandth above the horizon.
    if (normal.dot(to_viewer) < 1e-3)
        normal = (normal + to_viewer * (1e-3 - normal.dot(to_viewer))).normalized();
    const V2d uv = mesh.uvs.empty() ? V2d(0, 0) : blend(mesh.uvs, triangle, hit.b1, hit.b2);
    const V3d colour =
        mesh.colours.empty() ? V3d(1, 1, 1) : blend(mesh.colours, triangle, hit.b1, hit.b2);
    surface.reflection =
        reflection_of(scene_, scene_.materials[mesh.material], Imath::V2f(uv), colour);
    surface.reflection.normal = normal;
    return surface;
}

std::optional<Surface> Geometry::surface(const V3d& origin, const V3d& direction) const {
    const auto hit = solid_hit(origin, direction);
    if (!hit)
        return std::nullopt;
    return surface_at(*hit, direction);
}

bool Geometry::sees_sky(const V3d& origin, const V3d& direction) const {
    const bool has_holes =
        std::any_of(scene_.materials.begin(), scene_.materials.end(),
                    [](const scene::Material& m) { return m.alpha_cutoff.has_value(); });
    if (has_holes)
        return !solid_hit(origin, direction);
    RTCRay ray = ray_of(origin, direction, 0).ray;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(tree_.get(), &context, &ray);
    return ray.tfar >= 0;
}

V3d Geometry::origin_beside(const Surface& surface, const V3d& direction) const {
    // Single precision leaves about 6e-8 of the largest coordinate; stand off ten times that.
    const V3d& p = surface.position;
    const double scale = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 0.01});
    const double side = direction.dot(surface.face_normal) < 0 ? -1.0 : 1.0;
    return p + surface.face_normal * (side * 1e-6 * scale);
}

}  // namespace relume::reference
