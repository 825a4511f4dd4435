#include "tests/lab/charts/noise_sheet.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/image_file.h"
#include "protocol/wire/display.h"
#include "tests/lab/measures/display_exposure.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace relume::lab {

void write_noise_sheet(const std::filesystem::path& path,
                       const std::vector<std::vector<float>>& pictures,
                       std::uint32_t image_width,
                       const Crop& crop) {
    constexpr std::uint32_t kEnlarged = 4;
    constexpr std::uint32_t kGap = 4;
    const wire::Display display = display_for(pictures.front());
    const std::uint32_t column = crop.width * kEnlarged + kGap;
    const auto columns = static_cast<std::uint32_t>(pictures.size());
    bake::FloatImage sheet{.width = column * columns - kGap,
                           .height = crop.height * kEnlarged,
                           .channels = 3,
                           .values = {}};
    sheet.values.assign(std::size_t{sheet.width} * sheet.height * 3, 1.0F);
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t y = 0; y < sheet.height; ++y) {
            for (std::uint32_t x = 0; x < crop.width * kEnlarged; ++x) {
                const std::size_t from = std::size_t{crop.top + y / kEnlarged} * image_width +
                                         crop.left + x / kEnlarged;
                const std::size_t to = std::size_t{y} * sheet.width + i * column + x;
                for (std::size_t c = 0; c < 3; ++c) {
                    sheet.values[3 * to + c] = wire::srgb_from_linear(
                        wire::tone_mapped(pictures[i][3 * from + c], display));
                }
            }
        }
    }
    bake::write_png(path, sheet);
}

std::vector<float> read_picture(const std::filesystem::path& path,
                                std::uint32_t width,
                                std::uint32_t height) {
    const auto file = OIIO::ImageInput::open(path.string());
    std::vector<float> values(std::size_t{3} * width * height);
    if (!file || file->spec().width != static_cast<int>(width) ||
        file->spec().height != static_cast<int>(height) || file->spec().nchannels != 3 ||
        !file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, values.data())) {
        throw bake::BakeError(fmt::format("{}: no picture, expected one of {}×{} pixels",
                                          path.string(), width, height));
    }
    return values;
}

}  // namespace relume::lab
