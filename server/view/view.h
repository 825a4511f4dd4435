// What makes pixels of the sums of a scene's receivers.
#pragma once

#include "protocol/transport/camera_record.h"
#include "protocol/transport/receiver_layout.h"
#include "server/view/tile_run.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

// Where an image is looked at from, in the world, and how large it is.
struct Look {
    Imath::V3d eye{0, 0, 0};
    Imath::V3d look_at{0, 0, -1};  // along −Z where it is the eye
    Imath::V3d up{0, 1, 0};        // the axis farthest from the view where it lies along that
    double fov_degrees = 40;       // from the lower to the upper edge, 0.01 … 179
    std::uint32_t width = 1;
    std::uint32_t height = 1;

    friend bool operator==(const Look&, const Look&) = default;
};

// Vertices of a surface that an image shows, of the materials that are given their radiance
// (mesh/given_radiance.h).
struct SeenVertices {
    std::vector<std::uint32_t> vertices;  // ascending, each once
    std::vector<float> pixels;  // of each, on triangles of which it is a corner; above 0
    bool shows_others = true;   // whether the image shows vertices of other materials
};

// An image of what a scene's receivers have been given. Sums are [blocks][3][256], in the basis
// of their block and before tint (protocol/transport/block_basis.h). Each room has its own.
// Images are cut into tiles of 16×16 pixels, so that they can be made piece by piece.
//
// Not thread-safe, but for what is const: any number of threads may write tiles at a time.
class View {
  public:
    View() = default;
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    virtual ~View() = default;

    // Looks from elsewhere, or at an image of another size; in each pixel at one place. Spread
    // over the caller's arena. Returns whether camera, size or coverage may have changed: never
    // where receivers are the pixels of one camera.
    virtual bool look(const Look& look) = 0;
    // Looks closer, until the next look, at pixels in which different things meet. The same.
    virtual bool look_closer() = 0;

    // The image's size, in tiles.
    [[nodiscard]] virtual const transport::TileGrid& image() const = 0;
    // Where it is looked from, and along which directions.
    [[nodiscard]] virtual const transport::CameraRecord& camera() const = 0;
    // The part of each pixel that sees the scene, in [0, 1]: row by row from the top,
    // width·height values.
    virtual void write_coverage(std::span<float> coverage) const = 0;

    // How much the receivers of each block count in the image as it is looked at, [blocks], not
    // all 0 (engine::Session::set_block_weights); empty where all count alike. Of a block that
    // counts for nothing, sums are not looked at.
    [[nodiscard]] virtual std::vector<float> block_weights() const { return {}; }
    // Of the view as it is looked at.
    [[nodiscard]] virtual SeenVertices seen_vertices() const { return {}; }
    // The sums of the next image are not those of the image before.
    virtual void sums_have_changed() {}
    // Prepares for the tiles of one image of these sums.
    virtual void begin_image(std::span<const float> sums) = 0;
    // Tiles of that image, tint applied: the pixels of `pixels_of(image(), tiles)` alone,
    // interleaved RGB, row by row from the top, linear radiance, premultiplied by coverage.
    // Throws std::invalid_argument for a buffer of another size.
    virtual void write_tiles(std::span<const float> sums,
                             const TileRun& tiles,
                             std::span<float> rgb) const = 0;
};

// The whole image, 3·width·height floats. Spread over the caller's arena.
void write_image(View& view, std::span<const float> sums, std::span<float> rgb);
// Throws std::invalid_argument unless the buffer holds these pixels.
void require_size(std::span<const float> rgb, const PixelRect& pixels);

}  // namespace relume::view
