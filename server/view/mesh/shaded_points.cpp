#include "server/view/mesh/shaded_points.h"

#include "protocol/basis/cpu_clones.h"
#include "protocol/brdf/local_frame.h"
#include "server/view/mesh/rgb.h"
#include "server/view/mesh/vertex_radiance.h"

#include <cmath>
#include <span>

namespace relume::view {
namespace {

constexpr std::size_t kMost = ShadedPoints::kMost;

// Unit length; zeros stay zeros.
RELUME_CPU_CLONES void normalise(float* __restrict x,
                                 float* __restrict y,
                                 float* __restrict z,
                                 std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
        const float inverse = 1.0F / std::sqrt(square > 1e-30F ? square : 1e-30F);
        x[i] *= inverse;
        y[i] *= inverse;
        z[i] *= inverse;
    }
}

void raise_to_horizon(float* z, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        z[i] = z[i] > brdf::kLeastViewCosine ? z[i] : brdf::kLeastViewCosine;
    }
}

}  // namespace

void ShadedPoints::begin(const DrawnSurface& surface,
                         std::uint32_t material,
                         const PixelRays& rays) {
    surface_ = &surface;
    material_ = &surface.material(material);
    rays_ = rays;
    count_ = 0;
    h_.resize(kMost * material_->brdf->h.shape().depth);
}

void ShadedPoints::add(const SurfacePoint& point, const SamplePosition& pixel, float* weights) {
    const transport::SurfaceMesh& mesh = surface_->mesh();
    const auto& vertices = mesh.triangles[point.triangle].vertices;
    const float weight_0 = 1 - point.weight_1 - point.weight_2;
    const Imath::V3f normal = mesh.normals[vertices[0]] * weight_0 +
                              mesh.normals[vertices[1]] * point.weight_1 +
                              mesh.normals[vertices[2]] * point.weight_2;
    const Imath::V3f ray = rays_.direction(pixel.x, pixel.y);
    normals_.x[count_] = normal.x;
    normals_.y[count_] = normal.y;
    normals_.z[count_] = normal.z;
    towards_eye_.x[count_] = -ray.x;
    towards_eye_.y[count_] = -ray.y;
    towards_eye_.z[count_] = -ray.z;
    weights_[count_] = weights;
    if (material_->has_textures) {
        find_texture_sides(point, ray);
    }
    ++count_;
}

// The pixel's sides on the plane of the triangle, and from there to texture coordinates.
void ShadedPoints::find_texture_sides(const SurfacePoint& point, const Imath::V3f& ray) {
    const transport::SurfaceMesh& mesh = surface_->mesh();
    const transport::SurfaceTriangle& triangle = mesh.triangles[point.triangle];
    const Imath::V3f& corner = mesh.positions[triangle.vertices[0]];
    const Imath::V3f edge_1 = mesh.positions[triangle.vertices[1]] - corner;
    const Imath::V3f edge_2 = mesh.positions[triangle.vertices[2]] - corner;
    const Imath::V2f& uv = mesh.uvs[triangle.uvs[0]];
    const Imath::V2f uv_1 = mesh.uvs[triangle.uvs[1]] - uv;
    const Imath::V2f uv_2 = mesh.uvs[triangle.uvs[2]] - uv;
    uv_[count_] = uv + uv_1 * point.weight_1 + uv_2 * point.weight_2;
    const Imath::V3f normal = edge_1.cross(edge_2);
    const float facing = normal.dot(ray);
    const float depth = normal.dot(rays_.to(corner)) / facing;
    const float square = normal.dot(normal);
    const auto side_of = [&](const Imath::V3f& step) {
        const Imath::V3f side = (step - ray * (normal.dot(step) / facing)) * depth;
        return (uv_1 * side.dot(edge_2.cross(normal)) + uv_2 * side.dot(normal.cross(edge_1))) /
               square;
    };
    uv_across_[count_] = side_of(rays_.across());
    uv_along_[count_] = side_of(rays_.along());
}

Imath::V3f ShadedPoints::colour_at(std::size_t point, const DrawnLobe& lobe) const {
    if (lobe.texture == nullptr) {
        return lobe.colour;
    }
    return lobe.colour * lobe.texture->mean(uv_[point], uv_across_[point], uv_along_[point]);
}

void ShadedPoints::write_weights() {
    const auto plane = [this](const Plane& values) { return std::span(values).first(count_); };
    const auto room = [this](Plane& values) { return std::span(values).first(count_); };
    const std::size_t terms = material_->brdf->terms;
    const std::size_t lobes = material_->lobes.size();
    normalise(normals_.x.data(), normals_.y.data(), normals_.z.data(), count_);
    brdf::local_from_world(
        {plane(normals_.x), plane(normals_.y), plane(normals_.z)},
        {plane(towards_eye_.x), plane(towards_eye_.y), plane(towards_eye_.z)},
        {room(local_.x), room(local_.y), room(local_.z)});
    raise_to_horizon(local_.z.data(), count_);
    material_->brdf->h.evaluate(
        brdf::Directions{plane(local_.x), plane(local_.y), plane(local_.z)},
        std::span(h_).first(count_ * terms * lobes));
    constexpr std::size_t kMostLobes = brdf::FactoredBrdf::kMostLobes;
    std::array<Rgb, kMostLobes> colours;
    for (std::size_t point = 0; point < count_; ++point) {
        for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
            const Imath::V3f colour = colour_at(point, material_->lobes[lobe]);
            colours[lobe] = Rgb{colour.x, colour.y, colour.z, 0};
        }
        const float* h = &h_[point * terms * lobes];
        float* weights = weights_[point];
        for (std::size_t term = 0; term < terms; ++term) {
            Rgb sum{};
            for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
                sum += colours[lobe] * *h++;
            }
            store_rgb(sum, weights);
            weights += VertexRadiance::kFloatsPerTerm;
        }
    }
    count_ = 0;
}

}  // namespace relume::view
