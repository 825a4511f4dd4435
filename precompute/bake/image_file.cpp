#include "precompute/bake/image_file.h"

#include "precompute/bake/error.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <memory>

namespace relume::bake {
namespace {

OIIO::ImageSpec spec_of(const FloatImage& image, OIIO::TypeDesc type) {
    return {static_cast<int>(image.width), static_cast<int>(image.height),
            static_cast<int>(image.channels), type};
}

void write(const std::filesystem::path& path,
           const FloatImage& image,
           const OIIO::ImageSpec& spec) {
    // The temporary name ends like the real one, for OpenImageIO chooses the format by it.
    std::filesystem::path temporary = path;
    temporary.replace_filename("." + path.filename().string());
    const auto file = OIIO::ImageOutput::create(temporary.string());
    if (!file || !file->open(temporary.string(), spec) ||
        !file->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) || !file->close()) {
        throw BakeError(
            fmt::format("{}: {}", path.string(), file ? file->geterror() : OIIO::geterror()));
    }
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error) {
        throw BakeError(
            fmt::format("{}: cannot rename into place: {}", path.string(), error.message()));
    }
}

}  // namespace

void write_exr(const std::filesystem::path& path, const FloatImage& image) {
    OIIO::ImageSpec spec = spec_of(image, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    write(path, image, spec);
}

void write_png(const std::filesystem::path& path, const FloatImage& image) {
    OIIO::ImageSpec spec = spec_of(image, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    write(path, image, spec);
}

FloatImage resized(const FloatImage& image, std::uint32_t width, std::uint32_t height) {
    if (width == image.width && height == image.height) {
        return image;
    }
    const OIIO::ImageBuf source(spec_of(image, OIIO::TypeDesc::FLOAT),
                                const_cast<float*>(image.values.data()));
    const OIIO::ROI roi(0, static_cast<int>(width), 0, static_cast<int>(height), 0, 1, 0,
                        static_cast<int>(image.channels));
    const OIIO::ImageBuf target = OIIO::ImageBufAlgo::resize(source, "", 0, roi);
    FloatImage small{width, height, image.channels,
                     std::vector<float>(std::size_t{width} * height * image.channels)};
    if (!target.get_pixels(roi, OIIO::TypeDesc::FLOAT, small.values.data())) {
        throw BakeError(fmt::format("cannot resize an image: {}", target.geterror()));
    }
    return small;
}

}  // namespace relume::bake
