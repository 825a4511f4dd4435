// The image of a surface mesh under a camera that moves, from the sums of its vertices' terms.
#pragma once

#include "protocol/transport/mesh_section.h"
#include "server/view/mesh/block_weights.h"
#include "server/view/mesh/drawn_surface.h"
#include "server/view/mesh/given_radiance.h"
#include "server/view/mesh/tile_terms.h"
#include "server/view/mesh/vertex_radiance.h"
#include "server/view/mesh/visible_surface.h"
#include "server/view/view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::view {

// A vertex has as many receivers as its material's factored BRDF has terms. What is kept from
// one image to the next: the vertices' radiance while the sums stand, what shows where while it
// is looked from the same place, and, from the second such image on, how every point that shows
// makes a pixel of its vertices' radiance, as far as that fits kMostKeptBytes.
class MeshView final : public View {
  public:
    static constexpr std::size_t kMostKeptBytes = std::size_t{64} << 20;

    // `radiance`: of no sums yet. `frame` says where in the world the surface is. `given`, if
    // there is one, outlives the view.
    MeshView(std::shared_ptr<const DrawnSurface> surface,
             VertexRadiance radiance,
             const transport::FrameRecord& frame,
             const Look& beginning,
             const GivenRadiance* given = nullptr);

    bool look(const Look& look) override;
    bool look_closer() override;

    [[nodiscard]] const transport::TileGrid& image() const override { return image_; }
    [[nodiscard]] const transport::CameraRecord& camera() const override { return camera_; }
    void write_coverage(std::span<float> coverage) const override;

    [[nodiscard]] std::vector<float> block_weights() const override {
        return view::block_weights(*surface_, visible_, given_);
    }
    [[nodiscard]] SeenVertices seen_vertices() const override;
    void sums_have_changed() override { radiance_is_stale_ = true; }
    void begin_image(std::span<const float> sums) override;
    void write_tiles(std::span<const float> sums,
                     const TileRun& tiles,
                     std::span<float> rgb) const override;

    // What a client could draw the image from by itself, besides the mesh: of the sums of the
    // last image.
    [[nodiscard]] const VertexRadiance& radiance() const { return radiance_; }

  private:
    void forget_terms();
    void keep_terms();
    void take_given_radiance();
    [[nodiscard]] PixelRect pixels_of_tile(std::uint32_t tile) const;

    const std::shared_ptr<const DrawnSurface> surface_;
    const transport::FrameRecord frame_;
    VertexRadiance radiance_;
    bool radiance_is_stale_ = true;
    const GivenRadiance* const given_;
    std::uint64_t given_materials_ = 0;  // the version that terms were made for
    std::uint64_t given_radiance_ = 0;   // the version that is in the radiance
    Look look_;
    Pinhole pinhole_;
    transport::TileGrid image_;
    transport::CameraRecord camera_;
    VisibleSurface visible_;
    bool is_closer_ = false;
    std::uint32_t images_ = 0;     // as it is looked at
    std::vector<TileTerms> kept_;  // of every tile, or none
};

}  // namespace relume::view
