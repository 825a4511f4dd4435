#include "precompute/bake/mesh/surface_image.h"

#include "precompute/bake/mesh/surface_caster.h"
#include "protocol/brdf/local_frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::bake {
namespace {

// A texel's number along one side, wherever the coordinate leads.
std::int64_t wrapped(std::int64_t texel, std::int64_t side, transport::TextureWrap wrap) {
    const auto modulo = [](std::int64_t value, std::int64_t by) {
        return (value % by + by) % by;
    };
    switch (wrap) {
        case transport::TextureWrap::clamp:
            return std::clamp<std::int64_t>(texel, 0, side - 1);
        case transport::TextureWrap::mirror: {
            const std::int64_t place = modulo(texel, 2 * side);
            return place < side ? place : 2 * side - 1 - place;
        }
        case transport::TextureWrap::repeat:
            break;
    }
    return modulo(texel, side);
}

Imath::V3f texture_at(const transport::SurfaceTexture& texture, const Imath::V2f& uv) {
    const float x = uv.x * static_cast<float>(texture.width) - 0.5F;
    const float y = (1 - uv.y) * static_cast<float>(texture.height) - 0.5F;
    const auto left = static_cast<std::int64_t>(std::floor(x));
    const auto top = static_cast<std::int64_t>(std::floor(y));
    const float right_part = x - static_cast<float>(left);
    const float lower_part = y - static_cast<float>(top);
    Imath::V3f sum{0, 0, 0};
    for (std::int64_t dy = 0; dy < 2; ++dy) {
        for (std::int64_t dx = 0; dx < 2; ++dx) {
            const std::int64_t column = wrapped(left + dx, texture.width, texture.wrap_u);
            const std::int64_t row = wrapped(top + dy, texture.height, texture.wrap_v);
            const half* texel =
                &texture.rgb[static_cast<std::size_t>(3 * (row * texture.width + column))];
            const float weight = (dx == 0 ? 1 - right_part : right_part) *
                                 (dy == 0 ? 1 - lower_part : lower_part);
            sum += weight * Imath::V3f(texel[0], texel[1], texel[2]);
        }
    }
    return sum;
}

class Viewer {
  public:
    Viewer(const transport::Transport& transport, std::span<const double> values)
        : manifest_(transport.manifest()),
          surface_(transport.surface().value()),
          values_(values),
          caster_(surface_, manifest_.mesh->materials) {}

    // False where the ray meets nothing.
    bool look(const Imath::V3f& eye, const Imath::V3f& direction, Imath::V3d& radiance) const {
        const auto hit = caster_.closest_hit(eye, direction);
        if (!hit) {
            return false;
        }
        const transport::SurfaceTriangle& triangle = surface_.mesh.triangles[hit->triangle];
        const float second = hit->barycentric.x;
        const float third = hit->barycentric.y;
        const std::array<float, 3> weights{1 - second - third, second, third};
        Imath::V3f normal{0, 0, 0};
        Imath::V2f uv{0, 0};
        for (std::size_t i = 0; i < 3; ++i) {
            normal += weights[i] * surface_.mesh.normals[triangle.vertices[i]];
            uv += weights[i] * surface_.mesh.uvs[triangle.uvs[i]];
        }
        const transport::MaterialRecord& material =
            manifest_.mesh->materials[triangle.material];
        const brdf::FactoredBrdf& brdf = surface_.brdfs[material.brdf];
        Imath::V3f to_viewer =
            brdf::local_frame(normal.normalized()).local_from_world(-direction);
        to_viewer.z = std::max(to_viewer.z, brdf::kLeastViewCosine);
        std::vector<float> h(std::size_t{brdf.terms} * brdf.lobes);
        brdf.h.evaluate(to_viewer, h);
        for (std::uint32_t lobe = 0; lobe < brdf.lobes; ++lobe) {
            const transport::LobeRecord& record = material.lobes[lobe];
            Imath::V3f colour = record.colour;
            if (record.texture) {
                colour *= texture_at(surface_.textures[*record.texture], uv);
            }
            for (std::uint32_t term = 0; term < brdf.terms; ++term) {
                radiance += Imath::V3d(colour) * double{h[term * brdf.lobes + lobe]} *
                            interpolated(triangle, weights, term);
            }
        }
        return true;
    }

  private:
    [[nodiscard]] Imath::V3d interpolated(const transport::SurfaceTriangle& triangle,
                                          const std::array<float, 3>& weights,
                                          std::uint32_t term) const {
        Imath::V3d sum{0, 0, 0};
        for (std::size_t i = 0; i < 3; ++i) {
            const transport::VertexPlace place =
                manifest_.layout.clusters().place_of_vertex(triangle.vertices[i]);
            const double* block =
                &values_[std::size_t{place.block + term} * 3 * transport::kBlockSize];
            for (int c = 0; c < 3; ++c) {
                sum[c] +=
                    double{weights[i]} *
                    block[static_cast<std::size_t>(c) * transport::kBlockSize + place.slot];
            }
        }
        return sum;
    }

    const transport::Manifest& manifest_;
    const transport::Surface& surface_;
    std::span<const double> values_;
    SurfaceCaster caster_;
};

}  // namespace

SurfaceImage view_surface(const transport::Transport& transport,
                          std::span<const double> values,
                          const transport::CameraRecord& camera,
                          const transport::TileGrid& size,
                          std::uint32_t side) {
    const Viewer viewer(transport, values);
    const std::size_t count = std::size_t{size.width} * size.height;
    SurfaceImage image{.size = size,
                       .rgb = std::vector<Imath::V3d>(count, Imath::V3d(0)),
                       .coverage = std::vector<float>(count)};
    const float share = 1 / static_cast<float>(side * side);
    tbb::parallel_for(std::uint32_t{0}, size.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const std::size_t pixel = std::size_t{y} * size.width + x;
            for (std::uint32_t i = 0; i < side * side; ++i) {
                const auto at = [side](std::uint32_t place) {
                    return (static_cast<float>(place) + 0.5F) / static_cast<float>(side);
                };
                const Imath::V3f direction =
                    camera.direction_from_pixel(static_cast<float>(x) + at(i % side),
                                                static_cast<float>(y) + at(i / side), size);
                Imath::V3d radiance{0, 0, 0};
                if (viewer.look(camera.eye, direction, radiance)) {
                    image.rgb[pixel] += double{share} * radiance;
                    image.coverage[pixel] += share;
                }
            }
        }
    });
    return image;
}

}  // namespace relume::bake
