#include "protocol/transport/surface_textures.h"

#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace relume::transport {
namespace {

// Of one texture, in front of all texels.
struct TextureHead {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t wrap_u = 0;
    std::uint32_t wrap_v = 0;
};
constexpr std::uint32_t kWraps = 3;
constexpr std::uint32_t kMostTextures = 4096;

[[noreturn]] void fail(std::string_view file,
                       const std::string& where,
                       std::uint64_t found,
                       const std::string& expected) {
    throw TransportError(
        fmt::format("{}: {}: found {}, expected {}", file, where, found, expected));
}

std::uint64_t texel_bytes(const TextureHead& head) {
    return std::uint64_t{head.width} * head.height * 3 * sizeof(half);
}

void check_head(const TextureHead& head, std::size_t number, std::string_view file) {
    const auto require = [&](const char* what, std::uint32_t found, std::uint32_t low,
                             std::uint32_t high) {
        if (found < low || found > high) {
            fail(file, fmt::format("texture {}: {}", number, what), found,
                 fmt::format("{} to {}", low, high));
        }
    };
    require("width", head.width, 1, SurfaceTexture::kMostSide);
    require("height", head.height, 1, SurfaceTexture::kMostSide);
    require("wrapping of u", head.wrap_u, 0, kWraps - 1);
    require("wrapping of v", head.wrap_v, 0, kWraps - 1);
}

template <typename T>
void append(std::vector<std::byte>& bytes, const T* values, std::size_t count) {
    const auto* first = reinterpret_cast<const std::byte*>(values);
    bytes.insert(bytes.end(), first, first + count * sizeof(T));
}

std::uint32_t wrapped(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
    const std::int64_t texels = size;
    if (wrap == TextureWrap::clamp) {
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(at, 0, texels - 1));
    }
    const std::int64_t period = wrap == TextureWrap::mirror ? 2 * texels : texels;
    const std::int64_t within = (at % period + period) % period;
    return static_cast<std::uint32_t>(within < texels ? within : period - 1 - within);
}

// Along one side: the texels around a place, and how much the second counts.
struct TexelPair {
    std::uint32_t first;
    std::uint32_t second;
    float share;
};
TexelPair texels_around(float place, std::uint32_t size, TextureWrap wrap) {
    constexpr float kMost = 0x1p22F;  // beyond it a float knows no places between texels
    const float texels = place > -kMost && place < kMost ? place - 0.5F : 0;
    const float below = std::floor(texels);
    const auto first = static_cast<std::int64_t>(below);
    return {.first = wrapped(first, size, wrap),
            .second = wrapped(first + 1, size, wrap),
            .share = texels - below};
}

}  // namespace

float red_at(const SurfaceTexture& texture, const Imath::V2f& uv) {
    const TexelPair columns =
        texels_around(uv.x * static_cast<float>(texture.width), texture.width, texture.wrap_u);
    const TexelPair rows = texels_around((1 - uv.y) * static_cast<float>(texture.height),
                                         texture.height, texture.wrap_v);
    const auto red = [&](std::uint32_t column, std::uint32_t row) {
        return static_cast<float>(texture.rgb[3 * (std::size_t{row} * texture.width + column)]);
    };
    const auto in_row = [&](std::uint32_t row) {
        return red(columns.first, row) * (1 - columns.share) +
               red(columns.second, row) * columns.share;
    };
    return in_row(rows.first) * (1 - rows.share) + in_row(rows.second) * rows.share;
}

std::vector<std::byte> bytes_from_textures(std::span<const SurfaceTexture> textures) {
    const std::array<std::uint32_t, 4> counts{static_cast<std::uint32_t>(textures.size())};
    std::vector<std::byte> bytes;
    append(bytes, counts.data(), counts.size());
    for (const SurfaceTexture& texture : textures) {
        const TextureHead head{.width = texture.width,
                               .height = texture.height,
                               .wrap_u = static_cast<std::uint32_t>(texture.wrap_u),
                               .wrap_v = static_cast<std::uint32_t>(texture.wrap_v)};
        append(bytes, &head, 1);
    }
    for (const SurfaceTexture& texture : textures) {
        append(bytes, texture.rgb.data(), texture.rgb.size());
    }
    return bytes;
}

std::vector<SurfaceTexture> textures_from_bytes(std::span<const std::byte> bytes,
                                                std::string_view file) {
    std::array<std::uint32_t, 4> counts{};
    if (bytes.size() < sizeof(counts)) {
        fail(file, "length", bytes.size(), fmt::format("{} bytes or more", sizeof(counts)));
    }
    std::memcpy(counts.data(), bytes.data(), sizeof(counts));
    const std::uint32_t count = counts[0];
    if (count > kMostTextures) {
        fail(file, "count of textures", count, fmt::format("at most {}", kMostTextures));
    }
    for (std::size_t i = 1; i < counts.size(); ++i) {
        if (counts[i] != 0) {
            fail(file, "reserved number", counts[i], "0");
        }
    }
    std::uint64_t expected = sizeof(counts) + std::uint64_t{count} * sizeof(TextureHead);
    if (bytes.size() < expected) {
        fail(file, "length", bytes.size(), fmt::format("{} bytes or more", expected));
    }
    std::vector<TextureHead> heads(count);
    if (count > 0) {
        std::memcpy(heads.data(), bytes.data() + sizeof(counts), count * sizeof(TextureHead));
    }
    const std::byte* texels = bytes.data() + expected;
    for (std::size_t i = 0; i < count; ++i) {
        check_head(heads[i], i, file);
        expected += texel_bytes(heads[i]);
    }
    if (bytes.size() != expected) {
        fail(file, "length", bytes.size(), fmt::format("{} bytes", expected));
    }
    std::vector<SurfaceTexture> textures;
    for (std::size_t i = 0; i < count; ++i) {
        SurfaceTexture texture{.width = heads[i].width,
                               .height = heads[i].height,
                               .wrap_u = static_cast<TextureWrap>(heads[i].wrap_u),
                               .wrap_v = static_cast<TextureWrap>(heads[i].wrap_v),
                               .rgb = {}};
        texture.rgb.resize(texel_bytes(heads[i]) / sizeof(half));
        std::memcpy(static_cast<void*>(texture.rgb.data()), texels, texel_bytes(heads[i]));
        texels += texel_bytes(heads[i]);
        for (const half value : texture.rgb) {
            if (!(float{value} >= 0) || !std::isfinite(float{value})) {
                throw TransportError(
                    fmt::format("{}: texture {}: found {}, expected finite numbers that are "
                                "not negative",
                                file, i, float{value}));
            }
        }
        textures.push_back(std::move(texture));
    }
    return textures;
}

}  // namespace relume::transport
