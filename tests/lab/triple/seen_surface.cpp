#include "tests/lab/triple/seen_surface.h"

#include "precompute/bake/probes/light_probe.h"
#include "precompute/bake/receivers/vertex/refinement.h"
#include "precompute/bake/receivers/vertex/vertex_receivers.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/visibility.h"
#include "precompute/scene/builtin.h"
#include "precompute/scene/camera.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/brdf/factored_brdf.h"
#include "protocol/transport/visibility_field.h"
#include "protocol/tripling/material_field.h"
#include "protocol/tripling/texel_blocks.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace relume::lab {
namespace {

constexpr std::uint64_t kSeed = 1;

std::vector<const brdf::FactoredBrdf*> white(const brdf::FactoredBrdf& brdf,
                                             const scene::Scene& scene) {
    return std::vector<const brdf::FactoredBrdf*>(scene.materials.size(), &brdf);
}

bake::RefinedSurface refined(const bake::RayCaster& caster, std::size_t vertices) {
    const brdf::FactoredBrdf brdf = brdf::factored_lambert("white", Imath::V3f(1));
    const std::vector<const brdf::FactoredBrdf*> brdfs = white(brdf, caster.scene());
    const bake::LightProbe probe(caster, brdfs, {});
    return bake::refine_surface(caster.scene(), probe,
                                {.most_vertices = vertices, .target_error = 0});
}

}  // namespace

SeenSurface::SeenSurface(const SeenSurfaceOptions& options)
    : scene_(scene::build_builtin_scene(options.scene)),
      caster_(scene_),
      n_(options.face_resolution),
      words_(transport::words_of_visibility(n_)),
      side_(options.side),
      wavelets_(n_) {
    {
        const timing::Stopwatch watch;
        surface_ = refined(caster_, options.vertices);
        refine_seconds_ = watch.seconds();
    }
    {
        const timing::Stopwatch watch;
        cast();
        cast_seconds_ = watch.seconds();
    }
    const timing::Stopwatch watch;
    block_bits_.resize(bits_.size());
    for (std::size_t vertex = 0; vertex < vertex_count(); ++vertex) {
        wavelets_.append(bits(vertex));
        tripling::bits_in_blocks(n_, bits(vertex),
                                 std::span(block_bits_).subspan(vertex * words_, words_));
    }
    wavelet_seconds_ = watch.seconds();
    drawn_.mesh = surface_.mesh;
    materials_.resize(scene_.materials.size());
    to_surface_ = std::make_unique<bake::SurfaceCaster>(drawn_, materials_);
    look();
}

void SeenSurface::cast() {
    bits_.assign(vertex_count() * words_, 0);
    const brdf::FactoredBrdf brdf = brdf::factored_lambert("white", Imath::V3f(1));
    const bake::VertexReceivers receivers(scene_, surface_, white(brdf, scene_));
    const bake::LightTexels texels(n_, kSeed);
    const bake::Visibility visibility(caster_, texels, 0);
    struct Scratch {
        bake::Visibility::Scratch visibility;
        std::vector<float> wanted, open;
    };
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, vertex_count(), [&](std::size_t vertex) {
        Scratch& scratch = scratches.local();
        scratch.wanted.resize(texels.size());
        scratch.open.resize(texels.size());
        const Imath::V3f normal = surface_.mesh.normals[vertex];
        for (std::size_t place = 0; place < texels.size(); ++place) {
            const Imath::V3f direction(texels.direction_x()[place], texels.direction_y()[place],
                                       texels.direction_z()[place]);
            scratch.wanted[place] = direction.dot(normal) > 0 ? 1 : 0;
        }
        const bake::Receiver receiver = receivers.look(vertex);
        visibility.compute(receiver.surfaces.front().origins, 1, {}, scratch.wanted,
                           scratch.open, scratch.visibility);
        for (std::size_t place = 0; place < texels.size(); ++place) {
            if (scratch.open[place] > 0) {
                const std::size_t texel = texels.texel_index(place);
                bits_[vertex * words_ + texel / 64] |= std::uint64_t{1} << texel % 64;
            }
        }
    });
    for (const Scratch& scratch : scratches) {
        rays_ += scratch.visibility.rays;
    }
}

namespace {

// Calls visit(pixel, hit) for every pixel in which the surface shows.
template <typename Visit>
void for_each_hit(const bake::SurfaceCaster& surface,
                  const scene::CameraPlacement& placement,
                  std::uint32_t side,
                  const Visit& visit) {
    const scene::Camera camera(placement, side, side);
    for (std::size_t i = 0; i < std::size_t{side} * side; ++i) {
        const Imath::V3f direction = camera.direction_from_pixel(
            static_cast<float>(i % side) + 0.5F, static_cast<float>(i / side) + 0.5F);
        if (const auto hit = surface.closest_hit(camera.eye(), direction)) {
            visit(i, *hit);
        }
    }
}

}  // namespace

std::vector<std::uint32_t> SeenSurface::seen_from(const scene::CameraPlacement& camera,
                                                  std::uint32_t side) const {
    std::vector<bool> is_seen(vertex_count(), false);
    std::vector<std::uint32_t> seen;
    for_each_hit(
        *to_surface_, camera, side, [&](std::size_t /*pixel*/, const bake::SurfaceHit& hit) {
            for (const std::uint32_t vertex : surface_.mesh.triangles[hit.triangle].vertices) {
                if (!is_seen[vertex]) {
                    is_seen[vertex] = true;
                    seen.push_back(vertex);
                }
            }
        });
    return seen;
}

void SeenSurface::look() {
    constexpr std::uint32_t kUnseen = ~std::uint32_t{0};
    std::vector<std::uint32_t> seen_of_vertex(vertex_count(), kUnseen);
    pixels_.resize(std::size_t{side_} * side_);
    const Imath::V3f eye = scene_.camera.eye;
    for_each_hit(
        *to_surface_, scene_.camera, side_, [&](std::size_t i, const bake::SurfaceHit& hit) {
            Pixel& pixel = pixels_[i];
            pixel.is_covered = true;
            pixel.weights = {1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x,
                             hit.barycentric.y};
            const auto& corners = surface_.mesh.triangles[hit.triangle].vertices;
            for (std::size_t corner = 0; corner < pixel.seen.size(); ++corner) {
                const std::uint32_t vertex = corners[corner];
                if (seen_of_vertex[vertex] == kUnseen) {
                    seen_of_vertex[vertex] = static_cast<std::uint32_t>(seen_.size());
                    const Imath::V3f normal = surface_.mesh.normals[vertex];
                    const Imath::V3f viewer =
                        (eye - surface_.mesh.positions[vertex]).normalized();
                    seen_.push_back({.vertex = vertex,
                                     .normal = normal,
                                     .reflection = tripling::mirrored(viewer, normal)});
                }
                pixel.seen[corner] = seen_of_vertex[vertex];
            }
        });
}

std::vector<float> SeenSurface::image(std::span<const std::array<float, 3>> radiance) const {
    std::vector<float> image(3 * pixels_.size(), 0.0F);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        if (!pixels_[i].is_covered) {
            continue;
        }
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (std::size_t colour = 0; colour < 3; ++colour) {
                image[3 * i + colour] +=
                    pixels_[i].weights[corner] * radiance[pixels_[i].seen[corner]][colour];
            }
        }
    }
    return image;
}

}  // namespace relume::lab
