#include "client/cli/image_file.h"

#include "client/cli/client_error.h"
#include "protocol/base/files/atomic_file.h"
#include "protocol/base/files/disk_room.h"
#include "protocol/base/files/error.h"
#include "protocol/wire/display.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace relume::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kJpegQuality = 95;

// Encoded in memory, for encoders do not all notice that a disk is full.
void write_pixels(const fs::path& path,
                  const OIIO::ImageSpec& spec,
                  OIIO::TypeDesc type,
                  const void* pixels) {
    OIIO::Filesystem::IOVecOutput encoded;
    OIIO::Filesystem::IOProxy* proxy = &encoded;
    OIIO::ImageSpec into_memory = spec;
    into_memory.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path.string());
    if (!output) {
        throw ClientError(fmt::format("{}: {}", path.string(), OIIO::geterror()));
    }
    if (!output->open(path.string(), into_memory) || !output->write_image(type, pixels) ||
        !output->close()) {
        throw ClientError(fmt::format("{}: {}", path.string(), output->geterror()));
    }
    write_file(path, std::as_bytes(std::span(encoded.buffer())));
}

OIIO::ImageSpec spec_of(const wire::ImageHeader& header,
                        std::size_t channels,
                        OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(static_cast<int>(header.width), static_cast<int>(header.height),
                         static_cast<int>(channels), type);
    spec.attribute("Software", "relume");
    return spec;
}

// Plane by plane to pixel by pixel, without the alpha plane where `channels` is 3.
template <typename Value>
std::vector<Value> interleaved(const wire::HalfImage& image, std::size_t channels) {
    std::vector<Value> pixels(image.plane_size() * channels);
    for (std::size_t c = 0; c < channels; ++c) {
        const auto plane = image.plane(c);
        for (std::size_t i = 0; i < plane.size(); ++i) {
            pixels[i * channels + c] = plane[i];
        }
    }
    return pixels;
}

std::vector<std::uint8_t> displayed(const wire::HalfImage& image,
                                    const wire::Display& display,
                                    bool keep_alpha) {
    const std::size_t channels = keep_alpha ? 4 : 3;
    std::vector<std::uint8_t> pixels(image.plane_size() * channels);
    for (std::size_t i = 0; i < image.plane_size(); ++i) {
        const float coverage =
            keep_alpha ? std::clamp(static_cast<float>(image.plane(3)[i]), 0.0F, 1.0F) : 1.0F;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto premultiplied = static_cast<float>(image.plane(c)[i]);
            pixels[i * channels + c] = wire::code_from_linear(
                coverage > 0 ? premultiplied / coverage : premultiplied, display);
        }
        if (keep_alpha) {
            pixels[i * channels + 3] = static_cast<std::uint8_t>(255.0F * coverage + 0.5F);
        }
    }
    return pixels;
}

}  // namespace

ImageFormat image_format_from_path(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") {
        return ImageFormat::exr;
    }
    if (extension == ".hdr") {
        return ImageFormat::hdr;
    }
    if (extension == ".png") {
        return ImageFormat::png;
    }
    if (extension == ".jpg" || extension == ".jpeg") {
        return ImageFormat::jpeg;
    }
    throw ClientError(
        fmt::format("{}: found the extension \"{}\", expected .exr, .hdr, .png or .jpg",
                    path.string(), extension));
}

void write_image_file(const fs::path& path,
                      const wire::HalfImage& image,
                      const wire::ImageHeader& header,
                      const wire::Display& display) {
    switch (image_format_from_path(path)) {
        case ImageFormat::exr: {
            const std::size_t channels = image.plane_count();
            OIIO::ImageSpec spec = spec_of(header, channels, OIIO::TypeDesc::HALF);
            spec.attribute("compression", "zip");
            spec.attribute("relume:relative_error", header.relative_error);
            spec.attribute("relume:exact", header.exact ? 1 : 0);
            spec.attribute("relume:revision", std::to_string(header.revision));
            const auto pixels = interleaved<Imath::half>(image, channels);
            write_pixels(path, spec, OIIO::TypeDesc::HALF, pixels.data());
            break;
        }
        case ImageFormat::hdr: {
            const auto pixels = interleaved<float>(image, 3);
            write_pixels(path, spec_of(header, 3, OIIO::TypeDesc::FLOAT), OIIO::TypeDesc::FLOAT,
                         pixels.data());
            break;
        }
        case ImageFormat::png: {
            OIIO::ImageSpec spec = spec_of(header, image.plane_count(), OIIO::TypeDesc::UINT8);
            spec.attribute("oiio:UnassociatedAlpha", 1);
            const auto pixels = displayed(image, display, image.has_alpha);
            write_pixels(path, spec, OIIO::TypeDesc::UINT8, pixels.data());
            break;
        }
        case ImageFormat::jpeg: {
            OIIO::ImageSpec spec = spec_of(header, 3, OIIO::TypeDesc::UINT8);
            spec.attribute("Compression", fmt::format("jpeg:{}", kJpegQuality));
            const auto pixels = displayed(image, display, false);
            write_pixels(path, spec, OIIO::TypeDesc::UINT8, pixels.data());
            break;
        }
    }
}

void write_image_file(const fs::path& path,
                      std::span<const std::byte> jpeg,
                      const wire::ImageHeader& header) {
    const ImageFormat format = image_format_from_path(path);
    if (format == ImageFormat::jpeg) {
        write_file(path, jpeg);
        return;
    }
    if (format != ImageFormat::png) {
        throw ClientError(
            path.string() +
            ": found a display-referred image, expected a linear one for this format");
    }
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
    const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colour_space = 0;
    if (tjDecompressHeader3(decoder.get(), bytes, jpeg.size(), &width, &height, &subsampling,
                            &colour_space) != 0) {
        throw ClientError(
            fmt::format("JPEG from the server: {}", tjGetErrorStr2(decoder.get())));
    }
    if (width != static_cast<int>(header.width) || height != static_cast<int>(header.height)) {
        throw ClientError(fmt::format("JPEG from the server: found {}×{}, expected {}×{}",
                                      width, height, header.width, header.height));
    }
    std::vector<std::uint8_t> pixels(std::size_t{3} * header.width * header.height);
    if (tjDecompress2(decoder.get(), bytes, jpeg.size(), pixels.data(), width, 0, height,
                      TJPF_RGB, 0) != 0) {
        throw ClientError(
            fmt::format("JPEG from the server: {}", tjGetErrorStr2(decoder.get())));
    }
    write_pixels(path, spec_of(header, 3, OIIO::TypeDesc::UINT8), OIIO::TypeDesc::UINT8,
                 pixels.data());
}

void write_file(const fs::path& path, std::span<const std::byte> content) {
    try {
        files::write_file_atomically(path, {content});
    } catch (const files::FileError& error) {
        throw ClientError(error.what());
    }
}

void require_writable(const fs::path& path) {
    try {
        files::require_replaceable(path);
        files::require_room(path.has_parent_path() ? path.parent_path() : ".", 0, 0);
    } catch (const files::FileError& error) {
        throw ClientError(error.what());
    }
}

void write_file(const fs::path& path, std::string_view content) {
    write_file(path, std::as_bytes(std::span(content)));
}

}  // namespace relume::cli
