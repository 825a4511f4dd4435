// Image files to textures, through OpenImageIO.
#include "precompute/scene/error.h"
#include "precompute/scene/srgb.h"
#include "precompute/scene/texture.h"
#include "protocol/base/text/near_files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace relume::scene {
namespace {

constexpr std::size_t kRgba = 4;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw SceneError(SceneFault::bad_texture, fmt::format("texture '{}': {}", name, why));
}

// Grey, grey + alpha, RGB or RGBA, in steps of `channels`, to linear RGBA.
template <typename Value, typename Decode, typename DecodeAlpha>
std::vector<half> rgba_from(const std::vector<Value>& pixels,
                            std::size_t channels,
                            Decode decode,
                            DecodeAlpha decode_alpha) {
    const std::size_t count = pixels.size() / channels;
    const bool is_grey = channels < 3;
    const bool has_alpha = channels == 2 || channels == 4;
    std::vector<half> rgba(kRgba * count);
    for (std::size_t i = 0; i < count; ++i) {
        const Value* in = &pixels[i * channels];
        half* out = &rgba[i * kRgba];
        for (std::size_t c = 0; c < 3; ++c)
            out[c] = half(decode(in[is_grey ? 0 : c]));
        out[3] = half(has_alpha ? decode_alpha(in[channels - 1]) : 1.0F);
    }
    return rgba;
}

std::array<float, 256> byte_table(bool is_srgb) {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float value = static_cast<float>(i) / 255.0F;
        table[i] = is_srgb ? linear_from_srgb(value) : value;
    }
    return table;
}

// Half floats end at 65504; a texture is a reflectance or a direction and never needs more.
float bounded(float value) {
    return std::isfinite(value) ? std::clamp(value, -65504.0F, 65504.0F) : 0.0F;
}

Texture read_texture(const std::string& name, OIIO::ImageInput& input, TextureContent content) {
    const OIIO::ImageSpec& spec = input.spec();
    const auto limit = static_cast<int>(kMaxTextureSide);
    if (spec.width > limit || spec.height > limit)
        throw SceneError(SceneFault::too_large,
                         fmt::format("texture '{}' has {}x{} texels; expected at most {}x{}",
                                     name, spec.width, spec.height, limit, limit));
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
        refuse(name, fmt::format("{}x{}x{} with {} channels is no picture", spec.width,
                                 spec.height, spec.depth, spec.nchannels));
    const int channels = spec.nchannels > 4 ? 3 : spec.nchannels;
    const std::size_t values = static_cast<std::size_t>(spec.width) *
                               static_cast<std::size_t>(spec.height) *
                               static_cast<std::size_t>(channels);
    const auto width = static_cast<std::uint32_t>(spec.width);
    const auto height = static_cast<std::uint32_t>(spec.height);
    const bool is_srgb = content == TextureContent::colour && !spec.format.is_floating_point();
    const auto read = [&](OIIO::TypeDesc type, void* pixels) {
        if (!input.read_image(0, 0, 0, channels, type, pixels))
            refuse(name, input.geterror());
    };
    std::vector<half> rgba;
    const auto step = static_cast<std::size_t>(channels);
    if (spec.format == OIIO::TypeDesc::UINT8) {
        std::vector<std::uint8_t> pixels(values);
        read(OIIO::TypeDesc::UINT8, pixels.data());
        const auto colour = byte_table(is_srgb);
        const auto alpha = byte_table(false);
        rgba = rgba_from(
            pixels, step, [&](std::uint8_t v) { return colour[v]; },
            [&](std::uint8_t v) { return alpha[v]; });
    } else {
        std::vector<float> pixels(values);
        read(OIIO::TypeDesc::FLOAT, pixels.data());
        rgba = rgba_from(
            pixels, step, [&](float v) { return is_srgb ? linear_from_srgb(v) : bounded(v); },
            bounded);
    }
    return {name, width, height, std::move(rgba)};
}

OIIO::ImageSpec read_options() {
    OIIO::ImageSpec options;
    options["oiio:UnassociatedAlpha"] = 1;  // a cut-out's colour must not be darkened by alpha
    return options;
}

}  // namespace

Texture load_texture(const std::string& path, TextureContent content) {
    if (std::error_code error; !std::filesystem::is_regular_file(path, error))
        throw SceneError(SceneFault::missing_file,
                         fmt::format("texture '{}': {}", path,
                                     std::filesystem::exists(path, error)
                                         ? "expected a file, found something else"
                                         : text::text_from_missing_file(path)));
    const OIIO::ImageSpec options = read_options();
    const auto input = OIIO::ImageInput::open(path, &options);
    if (!input)
        refuse(path, OIIO::geterror());
    return read_texture(path, *input, content);
}

Texture decode_texture(const std::string& name,
                       std::span<const std::uint8_t> file,
                       TextureContent content) {
    OIIO::Filesystem::IOMemReader reader(OIIO::cspan<std::uint8_t>(
        file.data(), static_cast<OIIO::cspan<std::uint8_t>::size_type>(file.size())));
    OIIO::ImageSpec options = read_options();
    // Beside other options the reader is only found among them.
    OIIO::Filesystem::IOProxy* proxy = &reader;
    options.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open(name, &options);
    if (!input)
        refuse(name, OIIO::geterror());
    return read_texture(name, *input, content);
}

}  // namespace relume::scene
