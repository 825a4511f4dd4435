#include "protocol/light/file_signature.h"

#include "protocol/light/image_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace relume::light {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::size_t offset;
    std::string_view bytes;
    std::string_view name;
};

constexpr std::array kOthers{
    Signature{0, "\x89PNG"sv, "a PNG"},
    Signature{0, "\xFF\xD8\xFF"sv, "a JPEG"},
    Signature{0, "GIF8"sv, "a GIF"},
    Signature{0, "II*\0"sv, "a TIFF"},
    Signature{0, "MM\0*"sv, "a TIFF"},
    Signature{8, "WEBP"sv, "a WebP"},
    Signature{4, "ftyp"sv, "an AVIF, HEIF or video file"},
    Signature{0, "8BPS"sv, "a Photoshop file"},
    Signature{0, "DDS "sv, "a DDS texture"},
    Signature{1, "KTX "sv, "a KTX texture"},
    Signature{0, "BM"sv, "a BMP"},
    Signature{0, "PF\n"sv, "a PFM"},
    Signature{0, "Pf\n"sv, "a PFM"},
    Signature{0, "\xFF\x0A"sv, "a JPEG XL"},
    Signature{4, "JXL "sv, "a JPEG XL"},
    Signature{0, "PK\x03\x04"sv, "a ZIP archive"},
    Signature{0, "\x1F\x8B"sv, "a gzip archive"},
    Signature{0, "%PDF"sv, "a PDF"},
    Signature{0, "version https://git-lfs"sv, "a Git LFS pointer, not the file it stands for"},
    Signature{0, "<"sv, "a web page or XML"},
    Signature{0, "{"sv, "JSON"},
};

}  // namespace

ImageFormat require_image_format(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x76\x2f\x31\x01")) {
        return ImageFormat::openexr;
    }
    // Some programs leave out the first line.
    if (text.starts_with("#?") || text.starts_with("FORMAT=32-bit_rle_")) {
        return ImageFormat::radiance_hdr;
    }
    std::string found = bytes.empty() ? "empty" : "a file that begins with";
    const auto known =
        std::find_if(kOthers.begin(), kOthers.end(), [&](const Signature& signature) {
            return text.size() > signature.offset &&
                   text.substr(signature.offset).starts_with(signature.bytes);
        });
    if (known != kOthers.end()) {
        found = known->name;
    } else {
        for (const std::byte b : bytes.first(std::min<std::size_t>(bytes.size(), 4))) {
            found += fmt::format(" {:02x}", std::to_integer<unsigned>(b));
        }
    }
    refuse_image("environment", found, "a Radiance HDR or OpenEXR file");
}

}  // namespace relume::light
