// The vertices of a refined surface, what they see of the light, and which of them a camera
// sees.
#pragma once

#include "precompute/bake/mesh/surface_caster.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/scene/scene.h"
#include "protocol/tripling/visibility_wavelets.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relume::lab {

struct SeenSurfaceOptions {
    std::string scene = "table";  // built in
    std::size_t vertices = 80'000;
    std::uint32_t face_resolution = 64;
    std::uint32_t side = 512;  // of the image, in pixels
};

// A vertex that reaches the screen.
struct SeenVertex {
    std::uint32_t vertex = 0;
    Imath::V3f normal{0, 1, 0};
    Imath::V3f reflection{0, 1, 0};  // the mirrored direction to the camera
};

// Immutable and thread-safe.
class SeenSurface {
  public:
    // Refines the surface under natural light, as every bake of vertices does, and casts a ray
    // for every texel that lies above the vertex's normal. With the threads of the calling
    // arena. Throws as build_builtin_scene and refine_surface do.
    explicit SeenSurface(const SeenSurfaceOptions& options);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] std::size_t vertex_count() const { return surface_.vertex_count(); }
    [[nodiscard]] std::size_t triangle_count() const { return surface_.mesh.triangles.size(); }
    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    // A bit a texel, in the order of cubemap.h, and in squares (texel_blocks.h).
    [[nodiscard]] std::span<const std::uint64_t> bits(std::size_t vertex) const {
        return std::span(bits_).subspan(vertex * words_, words_);
    }
    [[nodiscard]] std::span<const std::uint64_t> bits_in_blocks(std::size_t vertex) const {
        return std::span(block_bits_).subspan(vertex * words_, words_);
    }
    [[nodiscard]] const tripling::VisibilityWavelets& wavelets() const { return wavelets_; }
    [[nodiscard]] std::span<const SeenVertex> seen() const { return seen_; }
    // Rays of the vertices, and seconds: to refine, to cast them, to make wavelets.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    [[nodiscard]] double refine_seconds() const { return refine_seconds_; }
    [[nodiscard]] double cast_seconds() const { return cast_seconds_; }
    [[nodiscard]] double wavelet_seconds() const { return wavelet_seconds_; }

    // The vertices that a camera sees in an image of `side` pixels a side, each once.
    [[nodiscard]] std::vector<std::uint32_t> seen_from(const scene::CameraPlacement& camera,
                                                       std::uint32_t side) const;
    [[nodiscard]] std::uint32_t side() const { return side_; }
    [[nodiscard]] const bake::RefinedSurface& surface() const { return surface_; }

    // The image of the scene's camera from radiances of seen(), linear between vertices; black
    // where nothing is. [side][side][3]
    [[nodiscard]] std::vector<float> image(
        std::span<const std::array<float, 3>> radiance) const;

  private:
    struct Pixel {
        bool is_covered = false;
        std::array<std::uint32_t, 3> seen{};  // corners, as indices into seen()
        std::array<float, 3> weights{};
    };

    void cast();
    void look();

    scene::Scene scene_;
    bake::RayCaster caster_;
    std::uint32_t n_;
    std::size_t words_;
    std::uint32_t side_;
    bake::RefinedSurface surface_;
    // As cameras see it; its materials have no holes.
    transport::Surface drawn_;
    std::vector<transport::MaterialRecord> materials_;
    std::unique_ptr<const bake::SurfaceCaster> to_surface_;
    std::vector<std::uint64_t> bits_;
    std::vector<std::uint64_t> block_bits_;
    tripling::VisibilityWavelets wavelets_;
    std::vector<SeenVertex> seen_;
    std::vector<Pixel> pixels_;
    std::uint64_t rays_ = 0;
    double refine_seconds_ = 0;
    double cast_seconds_ = 0;
    double wavelet_seconds_ = 0;
};

}  // namespace relume::lab
