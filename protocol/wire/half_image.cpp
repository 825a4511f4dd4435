#include "protocol/wire/half_image.h"

#include "protocol/wire/errors.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace relume::wire {
namespace {

constexpr std::uint16_t kHalfExponentMask = 0x7C00;

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
    throw WireError(ErrorCode::bad_image, "payload", found, expected);
}

void split_bytes(std::span<const Imath::half> plane, std::byte* low, std::byte* high) {
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const std::uint16_t bits = plane[i].bits();
        low[i] = static_cast<std::byte>(bits & 0xFFU);
        high[i] = static_cast<std::byte>(bits >> 8U);
    }
}

// Returns whether all values are finite.
bool join_bytes(const std::byte* low, const std::byte* high, std::span<Imath::half> plane) {
    bool finite = true;
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const auto bits = static_cast<std::uint16_t>(std::to_integer<unsigned>(low[i]) |
                                                     std::to_integer<unsigned>(high[i]) << 8U);
        finite = finite && (bits & kHalfExponentMask) != kHalfExponentMask;
        plane[i].setBits(bits);
    }
    return finite;
}

}  // namespace

Imath::half half_from_linear(float value) {
    if (std::isnan(value)) {
        return Imath::half(0.0F);
    }
    constexpr float kLargest = 65504;
    return Imath::half(std::clamp(value, -kLargest, kLargest));
}

struct HalfImageEncoder::Context {
    ZSTD_CCtx* zstd = ZSTD_createCCtx();
    std::vector<std::byte> split;

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    Context(Context&&) = delete;
    Context& operator=(Context&&) = delete;
    ~Context() { ZSTD_freeCCtx(zstd); }
};

HalfImageEncoder::HalfImageEncoder(int zstd_level) : context_(std::make_unique<Context>()) {
    if (context_->zstd == nullptr) {
        throw std::bad_alloc();
    }
    const std::size_t status =
        ZSTD_CCtx_setParameter(context_->zstd, ZSTD_c_compressionLevel, zstd_level);
    if (ZSTD_isError(status) != 0) {
        throw std::invalid_argument("zstd level " + std::to_string(zstd_level) + ": " +
                                    ZSTD_getErrorName(status));
    }
}

HalfImageEncoder::~HalfImageEncoder() = default;
HalfImageEncoder::HalfImageEncoder(HalfImageEncoder&&) noexcept = default;
HalfImageEncoder& HalfImageEncoder::operator=(HalfImageEncoder&&) noexcept = default;

std::size_t HalfImageEncoder::append_to(std::vector<std::byte>& out, const HalfImage& image) {
    const std::size_t plane_size = image.plane_size();
    const std::size_t value_count = image.plane_count() * plane_size;
    if (image.values.size() != value_count) {
        throw std::invalid_argument("half image: found " + std::to_string(image.values.size()) +
                                    " values, expected " + std::to_string(value_count));
    }
    context_->split.resize(2 * value_count);
    for (std::size_t p = 0; p < image.plane_count(); ++p) {
        std::byte* low = context_->split.data() + 2 * p * plane_size;
        split_bytes(image.plane(p), low, low + plane_size);
    }
    const std::size_t begin = out.size();
    out.resize(begin + ZSTD_compressBound(context_->split.size()));
    const std::size_t length =
        ZSTD_compress2(context_->zstd, out.data() + begin, out.size() - begin,
                       context_->split.data(), context_->split.size());
    if (ZSTD_isError(length) != 0) {
        out.resize(begin);
        throw std::runtime_error(std::string("half image: zstd: ") + ZSTD_getErrorName(length));
    }
    out.resize(begin + length);
    return length;
}

HalfImage decode_half_image(std::span<const std::byte> payload,
                            std::uint32_t width,
                            std::uint32_t height,
                            bool has_alpha) {
    HalfImage image{.width = width, .height = height, .has_alpha = has_alpha, .values = {}};
    const std::size_t plane_size = image.plane_size();
    const std::size_t value_count = image.plane_count() * plane_size;
    const std::size_t expected_bytes = 2 * value_count;

    const unsigned long long stated = ZSTD_getFrameContentSize(payload.data(), payload.size());
    if (stated == ZSTD_CONTENTSIZE_ERROR || stated == ZSTD_CONTENTSIZE_UNKNOWN) {
        refuse("no zstd frame with a stated size", "one");
    }
    if (stated != expected_bytes) {
        refuse(std::to_string(stated) + " bytes of planes", std::to_string(expected_bytes));
    }
    const std::size_t frame_bytes =
        ZSTD_findFrameCompressedSize(payload.data(), payload.size());
    if (ZSTD_isError(frame_bytes) != 0) {
        refuse(std::string("a broken zstd frame: ") + ZSTD_getErrorName(frame_bytes),
               "a whole one");
    }
    if (frame_bytes != payload.size()) {
        refuse(std::to_string(payload.size() - frame_bytes) + " bytes after the zstd frame",
               "exactly one frame");
    }
    std::vector<std::byte> split(expected_bytes);
    const std::size_t length =
        ZSTD_decompress(split.data(), split.size(), payload.data(), payload.size());
    if (ZSTD_isError(length) != 0) {
        refuse(std::string("a broken zstd frame: ") + ZSTD_getErrorName(length), "a whole one");
    }
    if (length != expected_bytes) {
        refuse(std::to_string(length) + " bytes of planes", std::to_string(expected_bytes));
    }
    image.values.resize(value_count);
    for (std::size_t p = 0; p < image.plane_count(); ++p) {
        const std::byte* low = split.data() + 2 * p * plane_size;
        const auto plane = std::span(image.values).subspan(p * plane_size, plane_size);
        if (!join_bytes(low, low + plane_size, plane)) {
            refuse("an infinite value or NaN in plane " + std::to_string(p), "finite values");
        }
    }
    return image;
}

}  // namespace relume::wire
