#include "precompute/bake/image_file.h"

#include "precompute/bake/base/error.h"
#include "protocol/base/files/atomic_file.h"

#include <OpenImageIO/filesystem.h>
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
           const OIIO::ImageSpec& spec,
           const char* format) {
    // Encoded in memory, for encoders do not all notice that a disk is full.
    OIIO::Filesystem::IOVecOutput encoded;
    OIIO::Filesystem::IOProxy* proxy = &encoded;
    OIIO::ImageSpec into_memory = spec;
    into_memory.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->open(path.string(), into_memory) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) || !output->close()) {
        throw BakeError(fmt::format("{}: {}", path.string(),
                                    output ? output->geterror() : OIIO::geterror()));
    }
    files::write_file_atomically(path, {files::bytes_of(encoded.buffer())});
}

}  // namespace

void write_exr(const std::filesystem::path& path, const FloatImage& image) {
    OIIO::ImageSpec spec = spec_of(image, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    write(path, image, spec, "openexr");
}

void write_png(const std::filesystem::path& path, const FloatImage& image) {
    OIIO::ImageSpec spec = spec_of(image, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    write(path, image, spec, "png");
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
