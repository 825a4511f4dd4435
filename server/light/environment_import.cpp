#include "server/light/environment_import.h"

#include "server/light/environment_error.h"
#include "server/light/texel_repair.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

namespace relume::light {
namespace {

constexpr std::uintmax_t kMaxLocalFileBytes = std::uintmax_t{2} << 30;

[[noreturn]] void refuse(const std::string& what, std::string found, std::string expected) {
    const std::string message = fmt::format("{} is {}, expected {}", what, found, expected);
    throw EnvironmentError(message, std::move(found), std::move(expected));
}

// The name OpenImageIO has for the format these bytes begin like.
const char* format_from(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x76\x2f\x31\x01")) {
        return "openexr";
    }
    if (text.starts_with("#?")) {
        return "hdr";
    }
    std::string found = "no bytes";
    if (!bytes.empty()) {
        found = "a file that begins with";
        for (const std::byte b : bytes.first(std::min<std::size_t>(bytes.size(), 4))) {
            found += fmt::format(" {:02x}", std::to_integer<unsigned>(b));
        }
    }
    refuse("environment", std::move(found), "a Radiance HDR or OpenEXR file");
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Which channels are red, green and blue; equal for grey. A layer "name.R" serves where no
// plain "R" is there.
std::array<int, 3> colour_channels(const OIIO::ImageSpec& spec,
                                   std::vector<std::string>& warnings) {
    if (spec.nchannels == 1) {
        return {0, 0, 0};
    }
    const auto find = [&](const std::string& name) {
        for (std::size_t i = 0; i < spec.channelnames.size(); ++i) {
            if (lower_case(spec.channelnames[i]) == name) {
                return static_cast<int>(i);
            }
        }
        return -1;
    };
    const auto triple = [&](const std::string& layer) {
        return std::array<int, 3>{find(layer + "r"), find(layer + "g"), find(layer + "b")};
    };
    const auto complete = [](const std::array<int, 3>& channels) {
        return std::all_of(channels.begin(), channels.end(), [](int c) { return c >= 0; });
    };
    if (spec.nchannels >= 3) {
        if (const auto channels = triple(""); complete(channels)) {
            return channels;
        }
        for (const std::string& name : spec.channelnames) {
            const std::string lower = lower_case(name);
            if (!lower.ends_with(".r")) {
                continue;
            }
            const std::string layer = lower.substr(0, lower.size() - 1);
            if (const auto channels = triple(layer); complete(channels)) {
                warnings.push_back(
                    fmt::format("layer {} used", name.substr(0, name.size() - 2)));
                return channels;
            }
        }
    }
    constexpr std::size_t kNamesShown = 8;
    const std::size_t shown = std::min(spec.channelnames.size(), kNamesShown);
    refuse("image",
           fmt::format(
               "of {} channels ({})", spec.nchannels,
               fmt::join(spec.channelnames.begin(),
                         spec.channelnames.begin() + static_cast<std::ptrdiff_t>(shown), ", ")),
           "one of 1 channel (grey) or with R, G and B");
}

void check_spec(const OIIO::ImageSpec& spec, std::size_t max_texels) {
    const std::string size = fmt::format("{}x{}", spec.width, spec.height);
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1) {
        refuse("image", fmt::format("{}x{}", size, spec.depth), "flat and not empty");
    }
    const auto width = static_cast<std::uint32_t>(spec.width);
    const auto height = static_cast<std::uint32_t>(spec.height);
    if (width > kMaxMapSide || height > kMaxMapSide ||
        std::size_t{width} * height > max_texels) {
        refuse("image", size,
               fmt::format("at most {} texels a side and {} in all", kMaxMapSide, max_texels));
    }
    if (spec.deep) {
        refuse("image", "deep", "one colour per texel");
    }
    if (spec.x != 0 || spec.y != 0 || spec.full_x != 0 || spec.full_y != 0 ||
        spec.full_width != spec.width || spec.full_height != spec.height) {
        refuse("image",
               fmt::format("a {} part at ({}, {}) of {}x{} at ({}, {})", size, spec.x, spec.y,
                           spec.full_width, spec.full_height, spec.full_x, spec.full_y),
               "one whose data window is its display window");
    }
}

Projection choose_projection(const OIIO::ImageSpec& spec, std::optional<Projection> given) {
    const auto width = static_cast<std::uint32_t>(spec.width);
    const auto height = static_cast<std::uint32_t>(spec.height);
    const std::string found = fmt::format("{}x{}", width, height);
    if (given) {
        if (!accepts_shape(*given, width, height)) {
            refuse("image", found, describe_shape(*given));
        }
        return *given;
    }
    const std::optional<Projection> detected = detect_projection(width, height);
    if (!detected) {
        refuse("image", found,
               fmt::format("{}, {}, {}, {} or {}", describe_shape(Projection::lat_long),
                           describe_shape(Projection::vertical_cross),
                           describe_shape(Projection::horizontal_cross),
                           describe_shape(Projection::angular_map),
                           describe_shape(Projection::cubemap_strip)));
    }
    return *detected;
}

void warn_of_primaries(const OIIO::ImageSpec& spec, std::vector<std::string>& warnings) {
    constexpr std::array<float, 8> kRec709{0.64F, 0.33F, 0.30F,   0.60F,
                                           0.15F, 0.06F, 0.3127F, 0.3290F};
    const OIIO::ParamValue* attribute =
        spec.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
    if (attribute == nullptr) {
        return;
    }
    const auto* stated = static_cast<const float*>(attribute->data());
    constexpr float kTolerance = 0.002F;
    if (!std::equal(kRec709.begin(), kRec709.end(), stated,
                    [](float a, float b) { return std::abs(a - b) <= kTolerance; })) {
        warnings.emplace_back(
            "the file states other primaries than Rec. 709; taken as Rec. 709");
    }
}

void read_channels(OIIO::ImageInput& input,
                   const OIIO::ImageSpec& spec,
                   const std::array<int, 3>& channels,
                   std::vector<float>& rgb) {
    constexpr OIIO::stride_t kTexelBytes = 3 * sizeof(float);
    const auto read = [&](int begin, int end, float* to) {
        if (!input.read_image(0, 0, begin, end, OIIO::TypeDesc::FLOAT, to, kTexelBytes)) {
            throw EnvironmentError("image cannot be read: " + input.geterror());
        }
    };
    rgb.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
               3);
    if (channels[1] == channels[0] + 1 && channels[2] == channels[0] + 2) {
        read(channels[0], channels[0] + 3, rgb.data());
        return;
    }
    if (channels[0] == channels[1] && channels[0] == channels[2]) {
        read(channels[0], channels[0] + 1, rgb.data());
        for (std::size_t i = 0; i < rgb.size(); i += 3) {
            rgb[i + 1] = rgb[i];
            rgb[i + 2] = rgb[i];
        }
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        read(channels.at(c), channels.at(c) + 1, rgb.data() + c);
    }
}

// Exif's codes: 1 upright, 2 mirrored, 3 upside down, 4 flipped; the others are on their side.
void turn_upright(MapImage& image, int orientation) {
    if (orientation < 1 || orientation > 4) {
        refuse("image", fmt::format("stored by columns (orientation {})", orientation),
               "one stored by rows");
    }
    const std::size_t row_values = std::size_t{image.width} * 3;
    if (orientation == 3 || orientation == 4) {
        for (std::uint32_t y = 0; y < image.height / 2; ++y) {
            const auto upper = image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row_values);
            const auto lower = image.rgb.begin() +
                               static_cast<std::ptrdiff_t>((image.height - 1 - y) * row_values);
            std::swap_ranges(upper, upper + static_cast<std::ptrdiff_t>(row_values), lower);
        }
    }
    if (orientation == 2 || orientation == 3) {
        for (std::uint32_t y = 0; y < image.height; ++y) {
            float* row = &image.rgb[y * row_values];
            for (std::uint32_t x = 0; x < image.width / 2; ++x) {
                std::swap_ranges(row + std::size_t{x} * 3, row + std::size_t{x} * 3 + 3,
                                 row + std::size_t{image.width - 1 - x} * 3);
            }
        }
    }
}

}  // namespace

ImportedImage import_image(std::span<const std::byte> file_bytes,
                           std::optional<Projection> projection,
                           std::size_t max_texels) {
    const char* format = format_from(file_bytes);
    OIIO::Filesystem::IOMemReader reader(file_bytes.data(), file_bytes.size());
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) {
        throw EnvironmentError(
            fmt::format("OpenImageIO here cannot read {}: {}", format, OIIO::geterror()));
    }
    input->threads(1);
    OIIO::ImageSpec config;
    OIIO::Filesystem::IOProxy* proxy = &reader;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    OIIO::ImageSpec spec;
    if (!input->open(format, spec, config)) {
        throw EnvironmentError("image cannot be read: " + input->geterror());
    }
    check_spec(spec, std::min(max_texels, kMaxMapTexels));

    ImportedImage result;
    result.projection = choose_projection(spec, projection);
    const std::array<int, 3> channels = colour_channels(spec, result.warnings);
    warn_of_primaries(spec, result.warnings);
    result.image.width = static_cast<std::uint32_t>(spec.width);
    result.image.height = static_cast<std::uint32_t>(spec.height);
    read_channels(*input, spec, channels, result.image.rgb);
    if (input->seek_subimage(1, 0)) {
        result.warnings.emplace_back("only the first part of the file is used");
    }
    turn_upright(result.image, spec.get_int_attribute("Orientation", 1));
    std::vector<std::string> repairs = repair_texels(result.image);
    std::move(repairs.begin(), repairs.end(), std::back_inserter(result.warnings));
    return result;
}

ImportedEnvironment import_environment(std::span<const std::byte> file_bytes,
                                       std::optional<Projection> projection) {
    ImportedImage imported = import_image(file_bytes, projection);
    return {EnvironmentMap(std::move(imported.image), imported.projection),
            std::move(imported.warnings)};
}

ImportedEnvironment import_environment(const std::filesystem::path& file,
                                       std::optional<Projection> projection) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) {
        throw EnvironmentError(fmt::format("{}: {}", file.string(), error.message()));
    }
    if (size > kMaxLocalFileBytes) {
        refuse(file.string(), fmt::format("{} bytes long", size),
               fmt::format("at most {}", kMaxLocalFileBytes));
    }
    std::vector<std::byte> bytes(size);
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream) {
        throw EnvironmentError(fmt::format("{}: cannot be read", file.string()));
    }
    try {
        return import_environment(bytes, projection);
    } catch (const EnvironmentError& e) {
        throw EnvironmentError(fmt::format("{}: {}", file.string(), e.what()), e.found(),
                               e.expected());
    }
}

}  // namespace relume::light
