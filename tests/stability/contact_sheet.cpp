#include "tests/stability/contact_sheet.h"

#include "protocol/wire/display.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace relume::stability {
namespace {

constexpr int kTileWidth = 288;
constexpr int kCaptionHeight = 20;
constexpr int kFontSize = 13;
constexpr int kGap = 6;

int factor_of(const RelitImage& image) {
    return std::max(1, kTileWidth / static_cast<int>(image.width));
}

void paint(OIIO::ImageBuf& sheet, const Tile& tile, int left, int top) {
    const int factor = factor_of(tile.image);
    const wire::Display display{.exposure_stops = double{tile.exposure_stops},
                                .tone = wire::Tone::linear};
    const int width = static_cast<int>(tile.image.width);
    const int height = static_cast<int>(tile.image.height);
    for (int y = 0; y < height * factor; ++y) {
        for (int x = 0; x < width * factor; ++x) {
            const auto source = static_cast<std::size_t>(y / factor * width + x / factor) * 3;
            float shown[3];
            for (std::size_t c = 0; c < 3; ++c) {
                shown[c] = wire::srgb_from_linear(
                    wire::tone_mapped(tile.image.rgb[source + c], display));
            }
            sheet.setpixel(left + x, top + y, shown);
        }
    }
    constexpr float kInk[] = {0.1F, 0.1F, 0.1F};
    if (!OIIO::ImageBufAlgo::render_text(sheet, left + 2,
                                         top + height * factor + kCaptionHeight - 6,
                                         tile.caption, kFontSize, "DejaVuSans", kInk)) {
        throw std::runtime_error("caption: " + sheet.geterror());
    }
}

}  // namespace

RelitImage image_of_faces(std::span<const float> radiance, std::uint32_t face_resolution) {
    const std::size_t n = face_resolution;
    const std::size_t plane = radiance.size() / 3;
    RelitImage image{static_cast<std::uint32_t>(6 * n), face_resolution, {}};
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t face = 0; face < 6; ++face) {
            for (std::size_t column = 0; column < n; ++column) {
                for (std::size_t c = 0; c < 3; ++c) {
                    image.rgb.push_back(radiance[c * plane + (face * n + row) * n + column]);
                }
            }
        }
    }
    return image;
}

float exposure_for(const RelitImage& reference) {
    std::vector<float> values = reference.rgb;
    const auto bright = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 100 * 99);
    std::nth_element(values.begin(), bright, values.end());
    return *bright > 0 ? -std::log2(*bright) : 0;
}

void write_contact_sheet(const std::filesystem::path& file,
                         std::span<const Tile> tiles,
                         std::size_t columns) {
    columns = std::min(columns, tiles.size());
    int tile_width = kTileWidth;
    int tile_height = 0;
    for (const Tile& tile : tiles) {
        const int factor = factor_of(tile.image);
        tile_width = std::max(tile_width, factor * static_cast<int>(tile.image.width));
        tile_height = std::max(tile_height, factor * static_cast<int>(tile.image.height));
    }
    tile_width += kGap;
    tile_height += kCaptionHeight + kGap;
    const std::size_t rows = (tiles.size() + columns - 1) / columns;
    const OIIO::ImageSpec spec(static_cast<int>(columns) * tile_width,
                               static_cast<int>(rows) * tile_height, 3, OIIO::TypeDesc::FLOAT);
    OIIO::ImageBuf sheet(spec);
    constexpr float kPaper[] = {1, 1, 1};
    OIIO::ImageBufAlgo::fill(sheet, kPaper);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        paint(sheet, tiles[i], static_cast<int>(i % columns) * tile_width,
              static_cast<int>(i / columns) * tile_height);
    }
    if (!sheet.write(file.string(), OIIO::TypeDesc::UINT8)) {
        throw std::runtime_error(file.string() + ": " + sheet.geterror());
    }
}

}  // namespace relume::stability
