#include "server/view/view.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace relume::view {

void require_size(std::span<const float> rgb, const PixelRect& pixels) {
    if (rgb.size() != pixels.float_count()) {
        throw std::invalid_argument(fmt::format("image buffer has {} values, expected {}",
                                                rgb.size(), pixels.float_count()));
    }
}

void write_image(View& view, std::span<const float> sums, std::span<float> rgb) {
    const transport::TileGrid& image = view.image();
    require_size(rgb, {.width = image.width, .height = image.height});
    view.begin_image(sums);
    tbb::parallel_for(std::uint32_t{0}, image.tiles_y(), [&](std::uint32_t row) {
        // All pixels of a row of tiles lie one after another in the image, too.
        const TileRun tiles{.row = row, .first = 0, .last = image.tiles_x()};
        const PixelRect pixels = pixels_of(image, tiles);
        view.write_tiles(
            sums, tiles,
            rgb.subspan(std::size_t{3} * pixels.top * image.width, pixels.float_count()));
    });
}

}  // namespace relume::view
