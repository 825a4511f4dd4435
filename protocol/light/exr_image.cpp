#include "protocol/light/environment_error.h"
#include "protocol/light/exr_header.h"
#include "protocol/light/exr_layers.h"
#include "protocol/light/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace relume::light {
namespace {

namespace exr = OPENEXR_IMF_NAMESPACE;

class MemoryStream : public exr::IStream {
  public:
    explicit MemoryStream(std::span<const std::byte> bytes) : IStream("image"), bytes_(bytes) {}

    bool read(char to[], int count) override {
        if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - at_) {
            throw EnvironmentError("image ends before it is complete");
        }
        std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
        at_ += static_cast<std::size_t>(count);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        at_ = std::min<std::uint64_t>(position, bytes_.size());
    }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

// The data window's texels, three colours each.
std::vector<float> read_channels(std::span<const std::byte> bytes,
                                 const ExrPart& part,
                                 const ExrLayer& layer) {
    const Imath::Box2i& window = part.data_window;
    const std::size_t width = width_of(window);
    MemoryStream stream(bytes);
    exr::MultiPartInputFile file(stream, 0, false);
    exr::InputPart input(file, static_cast<int>(layer.part));
    std::vector<float> rgb(width * height_of(window) * 3);
    const bool is_grey = layer.kind == ExrLayer::Kind::grey;
    exr::FrameBuffer buffer;
    for (std::size_t c = 0; c < (is_grey ? 1U : 3U); ++c) {
        buffer.insert(layer.channels.at(c),
                      exr::Slice::Make(exr::FLOAT, rgb.data() + c, window, 3 * sizeof(float),
                                       3 * sizeof(float) * width));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    for (std::size_t i = 0; is_grey && i < rgb.size(); i += 3) {
        rgb[i + 1] = rgb[i];
        rgb[i + 2] = rgb[i];
    }
    return rgb;
}

Primaries usable_primaries(const ExrPart& part) {
    return part.primaries && rec709_from(*part.primaries) ? *part.primaries : Primaries{};
}

// Luminance Y with (R − Y)/Y and (B − Y)/Y at every texel.
std::vector<float> colours_from_chroma(const ExrPart& part, std::vector<float> yrb) {
    const Imath::V3f weights(luminance_weights(usable_primaries(part)));
    for (std::size_t i = 0; i < yrb.size(); i += 3) {
        const float luminance = yrb[i];
        const float red = (yrb[i + 1] + 1) * luminance;
        const float blue = (yrb[i + 2] + 1) * luminance;
        yrb[i] = red;
        yrb[i + 1] = (luminance - weights.x * red - weights.z * blue) / weights.y;
        yrb[i + 2] = blue;
    }
    return yrb;
}

// With chroma for every fourth texel: the library knows how to bring the others back.
std::vector<float> read_quarter_chroma(std::span<const std::byte> bytes,
                                       const ExrPart& part,
                                       const ExrLayer& layer) {
    const Imath::Box2i& window = part.data_window;
    const std::size_t width = width_of(window);
    const std::string& luminance = layer.channels[0];
    const std::size_t dot = luminance.rfind('.');
    MemoryStream stream(bytes);
    exr::RgbaInputFile file(stream, dot == std::string::npos ? "" : luminance.substr(0, dot),
                            0);
    std::vector<exr::Rgba> texels(width * height_of(window));
    const auto origin =
        static_cast<std::ptrdiff_t>(window.min.x) +
        static_cast<std::ptrdiff_t>(window.min.y) * static_cast<std::ptrdiff_t>(width);
    file.setFrameBuffer(texels.data() - origin, 1, width);
    file.readPixels(window.min.y, window.max.y);
    std::vector<float> rgb;
    rgb.reserve(texels.size() * 3);
    for (const exr::Rgba& texel : texels) {
        rgb.insert(rgb.end(), {float{texel.r}, float{texel.g}, float{texel.b}});
    }
    return rgb;
}

// How often a channel of the part is sampled, along x and y.
Imath::V2i sampling_of(const ExrPart& part, const std::string& channel) {
    const auto found =
        std::find_if(part.channels.begin(), part.channels.end(),
                     [&](const ExrChannel& each) { return each.name == channel; });
    return {found->x_sampling, found->y_sampling};
}

// Colours of the data window's texels. `parts` is how many the file has.
std::vector<float> read_layer(std::span<const std::byte> bytes,
                              const ExrPart& part,
                              const ExrLayer& layer,
                              std::size_t parts) {
    const bool has_chroma = layer.kind == ExrLayer::Kind::luminance_chroma;
    const Imath::V2i every(1, 1);
    const Imath::V2i fourth(2, 2);
    if (has_chroma && parts == 1 && sampling_of(part, layer.channels[0]) == every &&
        sampling_of(part, layer.channels[1]) == fourth &&
        sampling_of(part, layer.channels[2]) == fourth) {
        return read_quarter_chroma(bytes, part, layer);
    }
    for (const std::string& channel : layer.channels) {
        if (const Imath::V2i sampling = sampling_of(part, channel); sampling != every) {
            refuse_image("channel " + channel,
                         fmt::format("sampled every {}x{} texels", sampling.x, sampling.y),
                         "one sample a texel");
        }
    }
    std::vector<float> values = read_channels(bytes, part, layer);
    return has_chroma ? colours_from_chroma(part, std::move(values)) : values;
}

// Into the display window: what lies outside it is left out, what is missing is black.
MapImage framed(const ExrPart& part,
                std::vector<float> rgb,
                std::vector<std::string>& warnings) {
    const Imath::Box2i& data = part.data_window;
    const Imath::Box2i& display = part.display_window;
    MapImage image{static_cast<std::uint32_t>(width_of(display)),
                   static_cast<std::uint32_t>(height_of(display)),
                   {}};
    if (data == display) {
        image.rgb = std::move(rgb);
        return image;
    }
    const Imath::Box2i shared(
        {std::max(data.min.x, display.min.x), std::max(data.min.y, display.min.y)},
        {std::min(data.max.x, display.max.x), std::min(data.max.y, display.max.y)});
    const std::string where = fmt::format(
        "{}x{} at ({}, {}) of {}x{} at ({}, {})", width_of(data), height_of(data), data.min.x,
        data.min.y, image.width, image.height, display.min.x, display.min.y);
    if (shared.isEmpty()) {
        refuse_image("data window", where, "one that shows something");
    }
    image.rgb.resize(std::size_t{image.width} * image.height * 3);
    for (int y = shared.min.y; y <= shared.max.y; ++y) {
        const auto from = static_cast<std::size_t>(y - data.min.y) * width_of(data) +
                          static_cast<std::size_t>(shared.min.x - data.min.x);
        const auto to = static_cast<std::size_t>(y - display.min.y) * image.width +
                        static_cast<std::size_t>(shared.min.x - display.min.x);
        std::copy_n(&rgb[from * 3], width_of(shared) * 3, &image.rgb[to * 3]);
    }
    const bool covers = shared == display;
    warnings.push_back(fmt::format(
        "data window is {}; {}", where,
        covers ? "what lies outside is left out" : "what it does not hold is black"));
    return image;
}

// Exif's codes: 1 upright, 2 mirrored, 3 upside down, 4 flipped; the others are on their side.
void turn_upright(MapImage& image, int orientation) {
    if (orientation < 1 || orientation > 4) {
        refuse_image("image", fmt::format("stored by columns (orientation {})", orientation),
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

ImageSize exr_size(std::span<const std::byte> bytes, const std::string& layer) {
    const std::vector<ExrPart> parts = walk_exr_headers(bytes, {});
    std::vector<std::string> ignored;
    const Imath::Box2i& window = parts[choose_layer(parts, layer, ignored).part].display_window;
    return {static_cast<std::uint32_t>(width_of(window)),
            static_cast<std::uint32_t>(height_of(window))};
}

ImageFile read_exr(std::span<const std::byte> bytes,
                   const std::string& label,
                   const ImageBounds& bounds) {
    const std::vector<ExrPart> parts = walk_exr(bytes, bounds);
    ImageFile result;
    const ExrLayer layer = choose_layer(parts, label, result.warnings);
    for (const ExrLayer& each : colour_layers(parts)) {
        result.layers.push_back(each.label);
    }
    const ExrPart& part = parts[layer.part];
    std::vector<float> rgb;
    try {
        rgb = read_layer(bytes, part, layer, parts.size());
    } catch (const EnvironmentError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {  // OpenEXR's are of several libraries' types
        throw EnvironmentError(fmt::format("image cannot be read: {}", failure.what()));
    }
    result.image = framed(part, std::move(rgb), result.warnings);
    turn_upright(result.image, part.orientation);
    result.layer = layer.label;
    result.primaries = usable_primaries(part);
    if (part.primaries && !rec709_from(*part.primaries)) {
        result.warnings.emplace_back("chromaticities span no colours; taken as Rec. 709");
    }
    return result;
}

}  // namespace relume::light
