#include "precompute/scene/surface_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace relume::scene {
namespace {

// Cosine left between the viewer and a normal that had to be bent towards it.
constexpr float kMinViewCosine = 1e-3F;

template <typename Value>
Value interpolated(std::span<const Value> values,
                   const Triangle& triangle,
                   const Imath::V2f& barycentric) {
    const float first = 1.0F - barycentric.x - barycentric.y;
    return values[triangle[0]] * first + values[triangle[1]] * barycentric.x +
           values[triangle[2]] * barycentric.y;
}

template <typename Value>
Value interpolated(const std::vector<Value>& values,
                   const Triangle& triangle,
                   const Imath::V2f& barycentric) {
    return interpolated(std::span<const Value>(values), triangle, barycentric);
}

PointUvs uvs_at(const Mesh& mesh, const Triangle& triangle, const Imath::V2f& barycentric) {
    PointUvs uvs;
    for (std::size_t set = 0; set <= mesh.more_uvs.size(); ++set) {
        if (const auto values = mesh.uv_set(set); !values.empty())
            uvs.of_set[set] = interpolated(values, triangle, barycentric);
    }
    return uvs;
}

// `normal` tilted as the normal map says, in the frame of the mesh's tangents.
Imath::V3f mapped_normal(const Scene& scene,
                         const Material& material,
                         const Mesh& mesh,
                         const Triangle& triangle,
                         const Imath::V2f& barycentric,
                         const PointUvs& uvs,
                         const Imath::V3f& normal) {
    if (!material.normal_texture || mesh.tangents.empty())
        return normal;
    const Imath::V4f along_u = interpolated(mesh.tangents, triangle, barycentric);
    const Imath::V3f flat(along_u.x, along_u.y, along_u.z);
    const Imath::V3f tangent = flat - normal * normal.dot(flat);
    const float length = tangent.length();
    if (!(length > 1e-6F))
        return normal;
    Frame frame{.tangent = tangent / length, .bitangent = {}, .normal = normal};
    const float side = mesh.tangents[triangle[0]].w;
    frame.bitangent = normal.cross(frame.tangent) * side;
    const TextureUse& use = *material.normal_texture;
    const Imath::V4f texel = scene.textures[use.texture].evaluate(uvs.of_set[use.uv_set]);
    const Imath::V3f local{(2.0F * texel.x - 1.0F) * material.normal_scale,
                           (2.0F * texel.y - 1.0F) * material.normal_scale,
                           std::max(2.0F * texel.z - 1.0F, 1e-3F)};
    return frame.to_world(local).normalized();
}

// On the geometric normal's side, and with the viewer above its horizon.
Imath::V3f viewer_sided(Imath::V3f normal,
                        const Imath::V3f& geometric_normal,
                        const Imath::V3f& to_viewer) {
    if (normal.dot(geometric_normal) < 0)
        normal = -normal;
    const float cosine = normal.dot(to_viewer);
    if (cosine < kMinViewCosine)
        normal = (normal + to_viewer * (kMinViewCosine - cosine)).normalized();
    return normal;
}

}  // namespace

Frame Frame::from_normal(const Imath::V3f& n) {
    const float sign = std::copysign(1.0F, n.z);
    const float a = -1.0F / (sign + n.z);
    const float b = n.x * n.y * a;
    return {.tangent = {1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x},
            .bitangent = {b, sign + n.y * n.y * a, -n.y},
            .normal = n};
}

Imath::V3f Frame::to_local(const Imath::V3f& world) const {
    return {world.dot(tangent), world.dot(bitangent), world.dot(normal)};
}

Imath::V3f Frame::to_world(const Imath::V3f& local) const {
    return tangent * local.x + bitangent * local.y + normal * local.z;
}

Imath::V3f SurfacePoint::reflect(const Imath::V3f& wi_world) const {
    if (!is_above_surface(wi_world))
        return {0, 0, 0};
    const Imath::V3f wi = shading.to_local(wi_world);
    return bsdf.evaluate(wi, wo) * std::max(wi.z, 0.0F);
}

SurfacePoint::Sample SurfacePoint::sample(float u_lobe, const Imath::V2f& u) const {
    const BsdfSample local = bsdf.sample(wo, u_lobe, u);
    Sample sample{.wi = shading.to_world(local.wi), .weight = local.weight, .pdf = local.pdf};
    if (local.pdf > 0 && !is_above_surface(sample.wi))
        sample.weight = {0, 0, 0};
    return sample;
}

float SurfacePoint::pdf(const Imath::V3f& wi_world) const {
    return bsdf.pdf(shading.to_local(wi_world), wo);
}

SurfacePoint surface_point(const Scene& scene,
                           std::uint32_t mesh_index,
                           std::uint32_t triangle_index,
                           const Imath::V2f& barycentric,
                           const Imath::V3f& ray_direction) {
    const Mesh& mesh = scene.meshes[mesh_index];
    const Triangle& triangle = mesh.triangles[triangle_index];
    const Material& material = scene.materials[mesh.material];
    const Imath::V3f& p0 = mesh.positions[triangle[0]];
    const Imath::V3f to_viewer = -ray_direction.normalized();
    SurfacePoint point;
    point.position = interpolated(mesh.positions, triangle, barycentric);
    for (const std::uint32_t index : triangle) {
        const Imath::V3f& p = mesh.positions[index];
        point.reach = std::max({point.reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const Imath::V3f face_normal =
        (mesh.positions[triangle[1]] - p0).cross(mesh.positions[triangle[2]] - p0).normalized();
    point.geometric_normal = face_normal.dot(to_viewer) < 0 ? -face_normal : face_normal;

    const PointUvs uvs = uvs_at(mesh, triangle, barycentric);
    Imath::V3f normal = face_normal;
    if (!mesh.normals.empty()) {
        const Imath::V3f smooth = interpolated(mesh.normals, triangle, barycentric);
        const float length = smooth.length();
        if (length > 1e-3F)
            normal = smooth / length;
    }
    normal = mapped_normal(scene, material, mesh, triangle, barycentric, uvs, normal);
    normal = viewer_sided(normal, point.geometric_normal, to_viewer);
    point.shading = Frame::from_normal(normal);
    point.wo = point.shading.to_local(to_viewer);
    const Imath::V3f colour = mesh.colours.empty()
                                  ? Imath::V3f(1, 1, 1)
                                  : interpolated(mesh.colours, triangle, barycentric);
    point.bsdf = material.bsdf_at(scene.textures, uvs, colour);
    return point;
}

bool is_solid_at(const Scene& scene,
                 std::uint32_t mesh_index,
                 std::uint32_t triangle_index,
                 const Imath::V2f& barycentric) {
    const Mesh& mesh = scene.meshes[mesh_index];
    const Material& material = scene.materials[mesh.material];
    if (!material.has_holes())
        return true;
    const Triangle& triangle = mesh.triangles[triangle_index];
    const float opacity =
        mesh.opacities.empty() ? 1.0F : interpolated(mesh.opacities, triangle, barycentric);
    return material.is_solid_at(scene.textures, uvs_at(mesh, triangle, barycentric), opacity);
}

bool has_holes(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& material) { return material.has_holes(); });
}

}  // namespace relume::scene
