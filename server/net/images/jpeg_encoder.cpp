#include "server/net/images/jpeg_encoder.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <stdexcept>

namespace relume::net {

void JpegEncoder::Destroy::operator()(void* compressor) const {
    tjDestroy(compressor);
}

JpegEncoder::JpegEncoder() : compressor_(tjInitCompress()) {
    if (!compressor_) {
        throw std::runtime_error(
            fmt::format("no JPEG compressor: {}", tjGetErrorStr2(nullptr)));
    }
}

std::span<const std::byte> JpegEncoder::encode(std::span<const std::uint8_t> rgb,
                                               std::uint32_t width,
                                               std::uint32_t height,
                                               int quality) {
    if (rgb.size() != std::size_t{3} * width * height) {
        throw std::runtime_error(
            fmt::format("{} values for a JPEG of {}x{} pixels, expected {}", rgb.size(), width,
                        height, std::size_t{3} * width * height));
    }
    const bool full_chroma = quality > kFullChromaQuality;
    const int subsampling = full_chroma ? TJSAMP_444 : TJSAMP_420;
    const unsigned long bound =
        tjBufSize(static_cast<int>(width), static_cast<int>(height), subsampling);
    if (bound == static_cast<unsigned long>(-1)) {
        throw std::runtime_error(fmt::format("no JPEG can have {}x{} pixels", width, height));
    }
    buffer_.resize(bound);
    unsigned char* out = buffer_.data();
    unsigned long bytes = bound;
    const int flags = TJFLAG_NOREALLOC | (full_chroma ? TJFLAG_ACCURATEDCT : TJFLAG_FASTDCT);
    if (tjCompress2(compressor_.get(), rgb.data(), static_cast<int>(width), 0,
                    static_cast<int>(height), TJPF_RGB, &out, &bytes, subsampling, quality,
                    flags) != 0) {
        throw std::runtime_error(
            fmt::format("JPEG compression failed: {}", tjGetErrorStr2(compressor_.get())));
    }
    return std::as_bytes(std::span(buffer_).first(bytes));
}

}  // namespace relume::net
