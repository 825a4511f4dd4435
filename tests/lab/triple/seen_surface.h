// The vertices of a baked surface, what they see of the light, and which of them a camera sees.
#pragma once

#include "precompute/bake/mesh/surface_caster.h"
#include "protocol/tripling/visibility_wavelets.h"
#include "server/scene/scene.h"
#include "server/triple/lit_surface.h"
#include "server/view/view.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::lab {

// A vertex that reaches the screen.
struct SeenVertex {
    std::uint32_t vertex = 0;
    Imath::V3f normal{0, 1, 0};
    Imath::V3f reflection{0, 1, 0};  // the mirrored direction to the camera
};

// Immutable and thread-safe.
class SeenSurface {
  public:
    // Of a scene that was baked by `relume-bake --receivers vertices --fields`, seen in square
    // images of `side` pixels a side, at first by its own camera. Throws std::invalid_argument
    // where no visibility of vertices is stored.
    SeenSurface(std::shared_ptr<const served::Scene> scene, std::uint32_t side);

    [[nodiscard]] std::uint32_t face_resolution() const { return lit_->face_resolution(); }
    [[nodiscard]] std::size_t vertex_count() const { return lit_->vertex_count(); }
    [[nodiscard]] std::size_t triangle_count() const { return surface().mesh.triangles.size(); }
    [[nodiscard]] const std::shared_ptr<const served::Scene>& scene() const { return scene_; }
    // As sessions have it, all vertices of material 0: a bit a texel, in squares
    // (texel_blocks.h).
    [[nodiscard]] const std::shared_ptr<const triple::LitSurface>& lit() const { return lit_; }
    [[nodiscard]] std::span<const std::uint64_t> bits_in_blocks(std::size_t vertex) const {
        return lit_->open(vertex);
    }
    [[nodiscard]] const tripling::VisibilityWavelets& wavelets() const { return wavelets_; }
    // Of the scene's own camera.
    [[nodiscard]] std::span<const SeenVertex> seen() const { return seen_; }
    // Bytes of visibility as it is stored, compressed.
    [[nodiscard]] std::uint64_t stored_bytes() const;
    // To make wavelets of the bits.
    [[nodiscard]] double wavelet_seconds() const { return wavelet_seconds_; }

    // The vertices that a camera sees, each once.
    [[nodiscard]] std::vector<SeenVertex> seen_from(const view::Look& look) const;
    // Where a look's eye is in the frame of the mesh.
    [[nodiscard]] Imath::V3f eye_in_frame(const view::Look& look) const;
    [[nodiscard]] std::uint32_t side() const { return side_; }

    // The image of the scene's camera from radiances of seen(), linear between vertices; black
    // where nothing is. Interleaved, [side][side][3].
    [[nodiscard]] std::vector<float> image(
        std::span<const std::array<float, 3>> radiance) const;

  private:
    struct Pixel {
        bool is_covered = false;
        std::array<std::uint32_t, 3> seen{};  // corners, as indices into seen()
        std::array<float, 3> weights{};
    };

    [[nodiscard]] const transport::Surface& surface() const {
        return *scene_->transport().surface();
    }
    std::vector<SeenVertex> look_at(const view::Look& look, std::vector<Pixel>& pixels) const;

    std::shared_ptr<const served::Scene> scene_;
    std::uint32_t side_;
    std::shared_ptr<const triple::LitSurface> lit_;
    tripling::VisibilityWavelets wavelets_;
    std::unique_ptr<const bake::SurfaceCaster> to_surface_;
    std::vector<SeenVertex> seen_;
    std::vector<Pixel> pixels_;
    double wavelet_seconds_ = 0;
};

}  // namespace relume::lab
