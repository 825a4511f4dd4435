#include "protocol/light/exr_header.h"

#include "protocol/light/environment_error.h"
#include "protocol/light/exr_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

namespace relume::light {
std::size_t width_of(const Imath::Box2i& window) {
    return static_cast<std::size_t>(std::int64_t{window.max.x} - window.min.x + 1);
}

std::size_t height_of(const Imath::Box2i& window) {
    return static_cast<std::size_t>(std::int64_t{window.max.y} - window.min.y + 1);
}

namespace {

constexpr std::uint32_t kTiled = 0x200;
constexpr std::uint32_t kLongNames = 0x400;
constexpr std::uint32_t kNonImage = 0x800;
constexpr std::uint32_t kMultipart = 0x1000;
constexpr std::size_t kMostParts = 256;
constexpr std::size_t kMostAttributes = 1024;
constexpr std::size_t kMostChannels = 1024;
constexpr std::array<const char*, 3> kWindows{"dataWindow", "displayWindow"};

struct Tiles {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint8_t mode = 0;  // low nibble: one level, mip map, rip map; high: rounded up
};

// One part as it is read: what only the walk itself needs.
struct Draft {
    ExrPart part;
    std::optional<Tiles> tiles;
    bool has_channels = false;
    bool has_compression = false;
    std::array<bool, 2> has_window{};
    std::optional<std::int32_t> stated_chunks;
};

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<ExrChannel> channels_from(std::span<const std::byte> value) {
    ExrReader reader(value);
    std::vector<ExrChannel> channels;
    for (;;) {
        ExrChannel channel;
        channel.name = reader.name();
        if (channel.name.empty()) {
            return channels;
        }
        constexpr std::array<std::size_t, 3> kBytes{4, 2, 4};  // uint, half, float
        const auto type = reader.number<std::uint32_t>();
        (void)reader.number<std::uint32_t>();  // pLinear and padding
        channel.x_sampling = reader.number<std::int32_t>();
        channel.y_sampling = reader.number<std::int32_t>();
        constexpr std::int32_t kMostSampling = 1 << 14;
        if (type >= kBytes.size() || channel.x_sampling < 1 || channel.y_sampling < 1 ||
            channel.x_sampling > kMostSampling || channel.y_sampling > kMostSampling ||
            channels.size() == kMostChannels) {
            refuse_image("list of channels", "broken",
                         fmt::format("at most {} channels of type 0 to 2", kMostChannels));
        }
        channel.bytes = kBytes.at(type);
        channels.push_back(std::move(channel));
    }
}

void check_value_size(const std::string& name,
                      std::span<const std::byte> value,
                      std::size_t expected) {
    if (value.size() != expected) {
        refuse_image("attribute " + name, fmt::format("{} bytes long", value.size()),
                     std::to_string(expected));
    }
}

void take_attribute(Draft& draft,
                    const std::string& name,
                    const std::string& type,
                    std::span<const std::byte> value) {
    ExrPart& part = draft.part;
    ExrReader reader(value);
    if (name == "channels") {
        part.channels = channels_from(value);
        draft.has_channels = true;
    } else if (name == "compression") {
        check_value_size(name, value, 1);
        part.compression = reader.number<std::uint8_t>();
        draft.has_compression = true;
    } else if (name == kWindows[0] || name == kWindows[1]) {
        check_value_size(name, value, 16);
        const bool is_data = name == kWindows[0];
        Imath::Box2i& window = is_data ? part.data_window : part.display_window;
        window.min.x = reader.number<std::int32_t>();
        window.min.y = reader.number<std::int32_t>();
        window.max.x = reader.number<std::int32_t>();
        window.max.y = reader.number<std::int32_t>();
        draft.has_window.at(is_data ? 0 : 1) = true;
    } else if (name == "tiles") {
        check_value_size(name, value, 9);
        Tiles tiles;
        tiles.width = reader.number<std::uint32_t>();
        tiles.height = reader.number<std::uint32_t>();
        tiles.mode = reader.number<std::uint8_t>();
        draft.tiles = tiles;
    } else if (name == "name" && type == "string") {
        part.name = text_of(value.first(std::min(value.size(), ExrReader::kMostNameBytes)));
    } else if (name == "type" && type == "string") {
        part.type = text_of(value.first(std::min(value.size(), ExrReader::kMostNameBytes)));
    } else if (name == "chunkCount" && value.size() == 4) {
        draft.stated_chunks = reader.number<std::int32_t>();
    } else if (name == "Orientation" && type == "int" && value.size() == 4) {
        part.orientation = reader.number<std::int32_t>();
    } else if (name == "chromaticities" && value.size() == 32) {
        std::array<double, 8> p{};
        for (double& coordinate : p) {
            coordinate = double{reader.number<float>()};
        }
        part.primaries = Primaries{.red = {p[0], p[1]},
                                   .green = {p[2], p[3]},
                                   .blue = {p[4], p[5]},
                                   .white = {p[6], p[7]}};
    }
}

// Empty where the list of parts ends.
std::optional<Draft> next_part(ExrReader& reader) {
    Draft draft;
    for (std::size_t count = 0;; ++count) {
        const std::string name = reader.name();
        if (name.empty()) {
            return count == 0 ? std::nullopt : std::optional(std::move(draft));
        }
        const std::string type = reader.name();
        const auto size = reader.number<std::int32_t>();
        if (count == kMostAttributes) {
            refuse_image("header", fmt::format("of more than {} attributes", kMostAttributes),
                         "fewer");
        }
        if (size < 0 || static_cast<std::size_t>(size) > reader.left()) {
            refuse_incomplete(fmt::format("in attribute {} of {} bytes, with {} bytes left",
                                          name, size, reader.left()));
        }
        take_attribute(draft, name, type, reader.take(static_cast<std::size_t>(size)));
    }
}

std::size_t lines_in_chunk(std::uint8_t compression) {
    constexpr std::array<std::size_t, 10> kLines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    if (compression >= kLines.size()) {
        refuse_image("compression", std::to_string(compression), "one of 0 to 9");
    }
    return kLines.at(compression);
}

std::size_t sample_bytes(const ExrPart& part) {
    std::size_t sum = 0;
    for (const ExrChannel& channel : part.channels) {
        sum += channel.bytes;
    }
    return sum;
}

// Sides of the levels of a tiled image, the largest first.
std::vector<std::size_t> level_sides(std::size_t side, bool up) {
    std::vector<std::size_t> sides{side};
    while (sides.back() > 1) {
        sides.push_back((sides.back() + (up ? 1 : 0)) / 2);
    }
    return sides;
}

std::size_t tile_count(const ExrPart& part, const Tiles& tiles) {
    const bool up = (tiles.mode >> 4U) != 0;
    const std::vector<std::size_t> widths = level_sides(width_of(part.data_window), up);
    const std::vector<std::size_t> heights = level_sides(height_of(part.data_window), up);
    const auto along = [](std::size_t side, std::size_t tile) {
        return (side + tile - 1) / tile;
    };
    std::size_t count = 0;
    switch (tiles.mode & 0xFU) {
        case 0:
            return along(widths[0], tiles.width) * along(heights[0], tiles.height);
        case 1:
            for (std::size_t i = 0; i < std::max(widths.size(), heights.size()); ++i) {
                count += along(i < widths.size() ? widths[i] : 1, tiles.width) *
                         along(i < heights.size() ? heights[i] : 1, tiles.height);
            }
            return count;
        case 2:
            for (const std::size_t width : widths) {
                for (const std::size_t height : heights) {
                    count += along(width, tiles.width) * along(height, tiles.height);
                }
            }
            return count;
        default:
            refuse_image("tiling", fmt::format("of mode {}", tiles.mode), "0, 1 or 2");
    }
}

// Bounds everything that reading the part allocates by.
void check_part(Draft& draft, bool is_tiled, bool is_multipart, const ImageBounds& bounds) {
    ExrPart& part = draft.part;
    if (!draft.has_channels || !draft.has_compression || !draft.has_window[0] ||
        !draft.has_window[1]) {
        refuse_image("header", "without channels, compression or windows", "all of them");
    }
    for (const Imath::Box2i* window : {&part.data_window, &part.display_window}) {
        if (window->isEmpty()) {
            refuse_image("window",
                         fmt::format("from ({}, {}) to ({}, {})", window->min.x, window->min.y,
                                     window->max.x, window->max.y),
                         "one that is not empty");
        }
        check_size(width_of(*window), height_of(*window), bounds);
    }
    if (part.type.empty()) {
        part.type = is_tiled ? "tiledimage" : "scanlineimage";
    }
    const bool has_tiles = part.type == "tiledimage" || part.type == "deeptile";
    if (is_multipart && part.name.empty()) {
        refuse_image("part", "without a name", "one, as there are several");
    }
    if (has_tiles != draft.tiles.has_value() && has_tiles) {
        refuse_image("tiled image", "without a size of tiles", "one");
    }
    std::size_t block_texels = 0;
    if (has_tiles) {
        constexpr std::uint32_t kLargestTile = 8192;
        const Tiles& tiles = *draft.tiles;
        if (tiles.width < 1 || tiles.height < 1 || tiles.width > kLargestTile ||
            tiles.height > kLargestTile) {
            refuse_image("tile", fmt::format("{}x{}", tiles.width, tiles.height),
                         fmt::format("1 to {} texels a side", kLargestTile));
        }
        part.chunk_count = tile_count(part, tiles);
        block_texels = std::size_t{tiles.width} * tiles.height;
    } else {
        const std::size_t lines = lines_in_chunk(part.compression);
        part.chunk_count = (height_of(part.data_window) + lines - 1) / lines;
        block_texels = lines * width_of(part.data_window);
    }
    if (const std::size_t block = block_texels * sample_bytes(part);
        block > bounds.max_block_bytes) {
        refuse_image("piece that is expanded at once", fmt::format("{} bytes", block),
                     fmt::format("at most {}", bounds.max_block_bytes));
    }
    if (draft.stated_chunks && !part.is_deep() &&
        *draft.stated_chunks != static_cast<std::int64_t>(part.chunk_count)) {
        refuse_image("image", fmt::format("of {} chunks", *draft.stated_chunks),
                     std::to_string(part.chunk_count));
    }
}

// The tables of all parts, and that every chunk they name is whole.
void check_chunks(ExrReader& reader,
                  std::span<const std::byte> bytes,
                  const std::vector<ExrPart>& parts,
                  bool is_multipart) {
    std::vector<std::uint64_t> begins;
    std::vector<std::size_t> head_bytes;  // before a chunk's size
    for (const ExrPart& part : parts) {
        if (part.chunk_count > reader.left() / sizeof(std::uint64_t)) {
            refuse_incomplete(fmt::format("in a table of {} chunks, with {} bytes left",
                                          part.chunk_count, reader.left()));
        }
        const bool has_tiles = part.type == "tiledimage";
        for (std::size_t i = 0; i < part.chunk_count; ++i) {
            begins.push_back(reader.number<std::uint64_t>());
            head_bytes.push_back((is_multipart ? 4U : 0U) + (has_tiles ? 16U : 4U));
        }
    }
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const std::size_t head = head_bytes[i] + sizeof(std::int32_t);
        if (begins[i] < reader.at() || begins[i] > bytes.size() ||
            bytes.size() - begins[i] < head) {
            refuse_incomplete(fmt::format("before chunk {} of {}", i + 1, begins.size()));
        }
        std::int32_t size = 0;
        std::memcpy(&size, &bytes[begins[i] + head_bytes[i]], sizeof size);
        if (size < 0 || static_cast<std::size_t>(size) > bytes.size() - begins[i] - head) {
            refuse_incomplete(fmt::format("in chunk {} of {}", i + 1, begins.size()));
        }
    }
}

bool has_several_parts(std::uint32_t version) {
    return (version & kMultipart) != 0;
}

std::uint32_t read_version(ExrReader& reader) {
    (void)reader.number<std::uint32_t>();  // the magic number
    const auto version = reader.number<std::uint32_t>();
    constexpr std::uint32_t kKnown = 0xFFU | kTiled | kLongNames | kNonImage | kMultipart;
    if ((version & 0xFFU) != 2 || (version & ~kKnown) != 0) {
        refuse_image("OpenEXR file", fmt::format("of version {:#x}", version), "version 2");
    }
    return version;
}

std::vector<ExrPart> read_headers(ExrReader& reader,
                                  std::uint32_t version,
                                  const ImageBounds& bounds) {
    const bool is_multipart = has_several_parts(version);
    std::vector<ExrPart> parts;
    while (std::optional<Draft> draft = next_part(reader)) {
        if ((version & kNonImage) != 0 && !is_multipart) {
            draft->part.type = "deepscanline";
        }
        if (draft->part.is_deep()) {
            refuse_image("image", "deep", "one colour per texel");
        }
        check_part(*draft, (version & kTiled) != 0, is_multipart, bounds);
        parts.push_back(std::move(draft->part));
        if (!is_multipart) {
            break;
        }
        if (parts.size() == kMostParts) {
            refuse_image("file", fmt::format("of {} parts or more", kMostParts), "fewer");
        }
    }
    if (parts.empty()) {
        refuse_image("file", "without a header", "one");
    }
    return parts;
}

}  // namespace

std::vector<ExrPart> walk_exr_headers(std::span<const std::byte> bytes,
                                      const ImageBounds& bounds) {
    ExrReader reader(bytes);
    const std::uint32_t version = read_version(reader);
    return read_headers(reader, version, bounds);
}

std::vector<ExrPart> walk_exr(std::span<const std::byte> bytes, const ImageBounds& bounds) {
    ExrReader reader(bytes);
    const std::uint32_t version = read_version(reader);
    std::vector<ExrPart> parts = read_headers(reader, version, bounds);
    check_chunks(reader, bytes, parts, has_several_parts(version));
    return parts;
}

}  // namespace relume::light
