#include "tests/lab/triple/seen_surface.h"

#include "precompute/scene/camera.h"
#include "protocol/base/timing/stopwatch.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

// Throws std::invalid_argument where it has none.
const transport::VisibilityField& visibility_of(const served::Scene& scene) {
    const transport::Transport& transport = scene.transport();
    if (!transport.surface() || !transport.visibility()) {
        throw std::invalid_argument(
            fmt::format("{}: no visibility of vertices is stored, expected a bake with "
                        "--receivers vertices --fields",
                        transport.directory().string()));
    }
    return *transport.visibility();
}

std::shared_ptr<const triple::LitSurface> lit_surface_of(const served::Scene& scene) {
    const transport::VisibilityField& visibility = visibility_of(scene);
    const transport::SurfaceMesh& mesh = scene.transport().surface()->mesh;
    return std::make_shared<triple::LitSurface>(
        mesh, std::vector<std::uint32_t>(mesh.vertex_count(), 0), visibility);
}

tripling::VisibilityWavelets wavelets_of(const transport::VisibilityField& visibility) {
    tripling::VisibilityWavelets wavelets(visibility.face_resolution());
    std::vector<std::uint64_t> bits;
    const std::size_t words = visibility.words_per_point();
    for (std::uint32_t block = 0; block < visibility.block_count(); ++block) {
        visibility.read(block, bits);
        for (std::size_t first = 0; first < bits.size(); first += words) {
            wavelets.append(std::span(bits).subspan(first, words));
        }
    }
    return wavelets;
}

}  // namespace

SeenSurface::SeenSurface(std::shared_ptr<const served::Scene> scene, std::uint32_t side)
    : scene_(std::move(scene)),
      side_(side),
      lit_(lit_surface_of(*scene_)),
      wavelets_(lit_->face_resolution()) {
    const timing::Stopwatch watch;
    wavelets_ = wavelets_of(visibility_of(*scene_));
    wavelet_seconds_ = watch.seconds();
    to_surface_ = std::make_unique<bake::SurfaceCaster>(
        surface(), scene_->transport().manifest().mesh->materials);
    seen_ = look_at(scene_->beginning(), pixels_);
}

std::uint64_t SeenSurface::stored_bytes() const {
    return std::filesystem::file_size(scene_->transport().directory() / "visibility.bin");
}

Imath::V3f SeenSurface::eye_in_frame(const view::Look& look) const {
    const transport::FrameRecord& frame = scene_->transport().manifest().mesh->frame;
    return Imath::V3f((look.eye - frame.origin) / frame.unit);
}

std::vector<SeenVertex> SeenSurface::seen_from(const view::Look& look) const {
    std::vector<Pixel> pixels;
    return look_at(look, pixels);
}

std::vector<SeenVertex> SeenSurface::look_at(const view::Look& look,
                                             std::vector<Pixel>& pixels) const {
    constexpr std::uint32_t kUnseen = ~std::uint32_t{0};
    const Imath::V3f eye = eye_in_frame(look);
    const scene::Camera camera(
        {.eye = eye,
         .look_at = eye + Imath::V3f((look.look_at - look.eye).normalized()),
         .up = Imath::V3f(look.up),
         .vertical_fov_degrees = static_cast<float>(look.fov_degrees)},
        side_, side_);
    const transport::SurfaceMesh& mesh = surface().mesh;
    std::vector<std::uint32_t> seen_of_vertex(vertex_count(), kUnseen);
    std::vector<SeenVertex> seen;
    pixels.assign(std::size_t{side_} * side_, {});
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Imath::V3f direction = camera.direction_from_pixel(
            static_cast<float>(i % side_) + 0.5F, static_cast<float>(i / side_) + 0.5F);
        const auto hit = to_surface_->closest_hit(eye, direction);
        if (!hit) {
            continue;
        }
        Pixel& pixel = pixels[i];
        pixel.is_covered = true;
        pixel.weights = {1 - hit->barycentric.x - hit->barycentric.y, hit->barycentric.x,
                         hit->barycentric.y};
        const auto& corners = mesh.triangles[hit->triangle].vertices;
        for (std::size_t corner = 0; corner < pixel.seen.size(); ++corner) {
            const std::uint32_t vertex = corners[corner];
            if (seen_of_vertex[vertex] == kUnseen) {
                seen_of_vertex[vertex] = static_cast<std::uint32_t>(seen.size());
                seen.push_back({.vertex = vertex,
                                .normal = mesh.normals[vertex],
                                .reflection = lit_->reflection(vertex, eye)});
            }
            pixel.seen[corner] = seen_of_vertex[vertex];
        }
    }
    return seen;
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
