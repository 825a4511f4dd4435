#include "tests/unit/light/image_files.h"

#include <OpenImageIO/filesystem.h>

#include <cstring>
#include <memory>
#include <stdexcept>

namespace relume::light::testing {

std::vector<std::byte> encode(const std::string& format,
                              int width,
                              int height,
                              const std::vector<std::string>& channels,
                              const std::vector<float>& values,
                              const std::function<void(OIIO::ImageSpec&)>& adjust) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = channels;
    adjust(spec);
    OIIO::Filesystem::IOVecOutput file;
    OIIO::Filesystem::IOProxy* proxy = &file;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output || !output->open(format, spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, values.data()) || !output->close()) {
        throw std::runtime_error("cannot encode " + format + ": " +
                                 (output ? output->geterror() : OIIO::geterror()));
    }
    std::vector<std::byte> bytes(file.buffer().size());
    std::memcpy(bytes.data(), file.buffer().data(), bytes.size());
    return bytes;
}

std::vector<std::byte> encode_rgb(const std::string& format, const MapImage& image) {
    return encode(format, static_cast<int>(image.width), static_cast<int>(image.height),
                  {"R", "G", "B"}, image.rgb);
}

}  // namespace relume::light::testing
