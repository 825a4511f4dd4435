// Whatever a server sends is an image within the limits or a WireError; a header that decodes
// encodes to the same bytes, and a payload to one of the same values.
#include "protocol/wire/errors.h"
#include "protocol/wire/half_image.h"
#include "protocol/wire/image_header.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

namespace wire = relume::wire;

// Larger images only take longer.
constexpr std::uint64_t kMaxPixels = 1U << 16U;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

void check_payload(const wire::ImageHeader& header, std::span<const std::byte> payload) {
    const wire::HalfImage image =
        wire::decode_half_image(payload, header.width, header.height, header.has_alpha);
    std::vector<std::byte> again;
    wire::HalfImageEncoder().append_to(again, image);
    const wire::HalfImage same =
        wire::decode_half_image(again, header.width, header.height, header.has_alpha);
    require(std::equal(image.values.begin(), image.values.end(), same.values.begin(),
                       same.values.end(),
                       [](Imath::half a, Imath::half b) { return a.bits() == b.bits(); }));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto frame = std::as_bytes(std::span(data, size));
    try {
        const wire::ImageHeader header = wire::decode_image_header(frame);
        const auto bytes = wire::encode_image_header(header);
        require(std::equal(bytes.begin(), bytes.end(), frame.begin()));
        if (header.encoding == wire::ImageEncoding::half_planes &&
            std::uint64_t{header.width} * header.height <= kMaxPixels) {
            check_payload(header, frame.subspan(wire::kImageHeaderBytes));
        }
    } catch (const wire::WireError& error) {
        require(error.code() == wire::ErrorCode::bad_image && !error.path().empty());
    }
    return 0;
}
