#include "protocol/light/environment_error.h"
#include "protocol/light/image_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

namespace relume::light {
namespace {

constexpr std::size_t kMostHeaderBytes = std::size_t{1} << 20;

using Rgbe = std::array<std::uint8_t, 4>;

// "-Y 64 +X 128": what the first and the second number count, and which way.
struct Axis {
    char letter = 'Y';
    bool grows = false;  // with '+': to the right, upwards
    std::uint32_t count = 0;
};

struct Header {
    Axis outer;  // of scanlines
    Axis inner;  // along a scanline
    std::string format;
    double exposure = 1;
    std::array<double, 3> correction{1, 1, 1};
    std::optional<Primaries> primaries;
    bool states_primaries = false;
    std::size_t data_offset = 0;

    [[nodiscard]] std::uint32_t width() const {
        return outer.letter == 'X' ? outer.count : inner.count;
    }
    [[nodiscard]] std::uint32_t height() const {
        return outer.letter == 'X' ? inner.count : outer.count;
    }
};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t begin = text.find_first_not_of(kBlank);
    return begin == std::string_view::npos
               ? std::string_view{}
               : text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string printable(std::string_view text) {
    constexpr std::size_t kShown = 60;
    std::string result(text.substr(0, kShown));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return result;
}

template <std::size_t Count>
std::optional<std::array<double, Count>> numbers(std::string_view text) {
    std::istringstream stream{std::string(text)};
    stream.imbue(std::locale::classic());
    std::array<double, Count> values{};
    for (double& value : values) {
        if (!(stream >> value)) {
            return std::nullopt;
        }
    }
    return values;
}

double positive(std::string_view key, std::string_view text) {
    const auto value = numbers<1>(text);
    if (!value || !((*value)[0] > 0) || !std::isfinite((*value)[0])) {
        refuse_image(key, printable(text), "a number above 0");
    }
    return (*value)[0];
}

class HeaderReader {
  public:
    explicit HeaderReader(std::span<const std::byte> bytes)
        : text_(reinterpret_cast<const char*>(bytes.data()),
                std::min(bytes.size(), kMostHeaderBytes)),
          is_cut_(bytes.size() <= kMostHeaderBytes) {}

    [[nodiscard]] Header read() {
        for (;;) {
            const std::string_view line = trimmed(next_line());
            if (line.empty()) {
                break;
            }
            take(line);
        }
        const std::string_view resolution = next_line();
        take_resolution(trimmed(resolution));
        header_.data_offset = at_;
        if (header_.format.empty()) {
            header_.format = "32-bit_rle_rgbe";
        }
        return std::move(header_);
    }

  private:
    std::string_view next_line() {
        const std::size_t end = text_.find('\n', at_);
        if (end == std::string_view::npos) {
            if (is_cut_) {
                refuse_incomplete("in its header");
            }
            refuse_image("header", fmt::format("longer than {} bytes", kMostHeaderBytes),
                         "an empty line and the resolution");
        }
        const std::string_view line = text_.substr(at_, end - at_);
        at_ = end + 1;
        return line;
    }

    void take(std::string_view line) {
        const std::size_t equals = line.find('=');
        if (line.starts_with('#') || equals == std::string_view::npos) {
            return;
        }
        const std::string_view key = trimmed(line.substr(0, equals));
        const std::string_view value = trimmed(line.substr(equals + 1));
        if (key == "FORMAT") {
            header_.format = value;
        } else if (key == "EXPOSURE") {
            header_.exposure *= positive(key, value);
        } else if (key == "COLORCORR") {
            const auto factors = numbers<3>(value);
            if (!factors || !std::all_of(factors->begin(), factors->end(), [](double factor) {
                    return factor > 0 && std::isfinite(factor);
                })) {
                refuse_image(key, printable(value), "three numbers above 0");
            }
            for (std::size_t c = 0; c < 3; ++c) {
                header_.correction.at(c) *= factors->at(c);
            }
        } else if (key == "PRIMARIES") {
            header_.states_primaries = true;
            if (const auto p = numbers<8>(value)) {
                header_.primaries = Primaries{.red = {(*p)[0], (*p)[1]},
                                              .green = {(*p)[2], (*p)[3]},
                                              .blue = {(*p)[4], (*p)[5]},
                                              .white = {(*p)[6], (*p)[7]}};
            }
        }
    }

    void take_resolution(std::string_view line) {
        std::istringstream stream{std::string(line)};
        std::string first;
        std::string second;
        std::string rest;
        std::string first_count;
        std::string second_count;
        stream >> first >> first_count >> second >> second_count;
        const auto axis = [&](const std::string& name, const std::string& count) {
            Axis result;
            const bool is_axis = name.size() == 2 && (name[0] == '+' || name[0] == '-') &&
                                 (name[1] == 'X' || name[1] == 'Y');
            const auto parsed =
                std::from_chars(count.data(), count.data() + count.size(), result.count);
            if (!is_axis || parsed.ec != std::errc{} ||
                parsed.ptr != count.data() + count.size() || result.count == 0) {
                refuse_image("resolution", printable(line), "one like -Y 512 +X 1024");
            }
            result.letter = name[1];
            result.grows = name[0] == '+';
            return result;
        };
        header_.outer = axis(first, first_count);
        header_.inner = axis(second, second_count);
        if (header_.outer.letter == header_.inner.letter || (stream >> rest)) {
            refuse_image("resolution", printable(line), "one like -Y 512 +X 1024");
        }
    }

    std::string_view text_;
    bool is_cut_;
    std::size_t at_ = 0;
    Header header_;
};

// Scanlines one after the other, each as many texels as asked for.
class Scanlines {
  public:
    Scanlines(std::span<const std::byte> bytes, std::uint32_t length, std::uint32_t count)
        : bytes_(bytes), length_(length), count_(count), line_(length) {}

    [[nodiscard]] const std::vector<Rgbe>& next() {
        ++number_;
        constexpr std::uint32_t kLeastForRuns = 8;
        constexpr std::uint32_t kMostForRuns = 32767;
        const bool may_have_runs = length_ >= kLeastForRuns && length_ <= kMostForRuns;
        if (may_have_runs && left() >= 4 && peek(0) == 2 && peek(1) == 2 && peek(2) < 128) {
            read_channels();
        } else {
            read_texels();
        }
        return line_;
    }

  private:
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    [[nodiscard]] std::uint8_t peek(std::size_t ahead) const {
        return std::to_integer<std::uint8_t>(bytes_[at_ + ahead]);
    }
    std::uint8_t take() {
        if (at_ >= bytes_.size()) {
            refuse_incomplete(fmt::format("in scanline {} of {}", number_, count_));
        }
        return std::to_integer<std::uint8_t>(bytes_[at_++]);
    }
    [[noreturn]] void refuse_run(std::size_t run) const {
        refuse_image(fmt::format("scanline {}", number_), fmt::format("a run of {}", run),
                     fmt::format("at most {} texels in all", length_));
    }

    // The new encoding: four channels one after the other, runs and literals of bytes.
    void read_channels() {
        const std::size_t stated = std::size_t{peek(2)} << 8U | peek(3);
        if (stated != length_) {
            refuse_image(fmt::format("scanline {}", number_),
                         fmt::format("{} texels long", stated), std::to_string(length_));
        }
        at_ += 4;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            for (std::size_t x = 0; x < length_;) {
                constexpr std::uint8_t kRun = 128;
                const std::uint8_t code = take();
                const std::size_t count = code > kRun ? code - kRun : code;
                if (count == 0 || count > length_ - x) {
                    refuse_run(count);
                }
                if (code > kRun) {
                    const std::uint8_t value = take();
                    for (std::size_t i = 0; i < count; ++i) {
                        line_[x++].at(channel) = value;
                    }
                } else {
                    for (std::size_t i = 0; i < count; ++i) {
                        line_[x++].at(channel) = take();
                    }
                }
            }
        }
    }

    // Texels as they are; (1, 1, 1, n) repeats the one before n times, and n·256ᵏ times when it
    // is the k-th such in a row.
    void read_texels() {
        unsigned shift = 0;
        for (std::size_t x = 0; x < length_;) {
            Rgbe texel{};
            for (std::uint8_t& value : texel) {
                value = take();
            }
            if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
                line_[x++] = texel;
                last_ = texel;
                shift = 0;
                continue;
            }
            constexpr unsigned kLargestShift = 24;
            const std::size_t count =
                shift > kLargestShift ? SIZE_MAX : std::size_t{texel[3]} << shift;
            if (!last_ || count > length_ - x) {
                refuse_run(count);
            }
            std::fill_n(line_.begin() + static_cast<std::ptrdiff_t>(x), count, *last_);
            x += count;
            shift += 8;
        }
    }

    std::span<const std::byte> bytes_;
    std::uint32_t length_;
    std::uint32_t count_;
    std::vector<Rgbe> line_;
    std::optional<Rgbe> last_;
    std::uint32_t number_ = 0;
    std::size_t at_ = 0;
};

Header read_header(std::span<const std::byte> bytes) {
    Header header = HeaderReader(bytes).read();
    if (header.format != "32-bit_rle_rgbe" && header.format != "32-bit_rle_xyze") {
        refuse_image("FORMAT", printable(header.format), "32-bit_rle_rgbe or 32-bit_rle_xyze");
    }
    return header;
}

// Texels in the order of the file to rows from the top left.
MapImage upright(const Header& header, std::vector<float> in_file_order) {
    const Axis& outer = header.outer;
    const Axis& inner = header.inner;
    MapImage image{header.width(), header.height(), {}};
    if (outer.letter == 'Y' && !outer.grows && inner.grows) {
        image.rgb = std::move(in_file_order);
        return image;
    }
    image.rgb.resize(in_file_order.size());
    const float* texel = in_file_order.data();
    for (std::uint32_t i = 0; i < outer.count; ++i) {
        for (std::uint32_t k = 0; k < inner.count; ++k, texel += 3) {
            const std::uint32_t along_x = outer.letter == 'X' ? i : k;
            const std::uint32_t along_y = outer.letter == 'X' ? k : i;
            const bool right = outer.letter == 'X' ? outer.grows : inner.grows;
            const bool up = outer.letter == 'X' ? inner.grows : outer.grows;
            const std::size_t x = right ? along_x : image.width - 1 - along_x;
            const std::size_t y = up ? image.height - 1 - along_y : along_y;
            std::copy_n(texel, 3, &image.rgb[(y * image.width + x) * 3]);
        }
    }
    return image;
}

}  // namespace

ImageSize radiance_hdr_size(std::span<const std::byte> bytes) {
    const Header header = read_header(bytes);
    return {header.width(), header.height()};
}

ImageFile read_radiance_hdr(std::span<const std::byte> bytes, const ImageBounds& bounds) {
    const Header header = read_header(bytes);
    check_size(header.width(), header.height(), bounds);
    std::array<float, 3> scale{};
    for (std::size_t c = 0; c < 3; ++c) {
        scale.at(c) = static_cast<float>(1 / (header.exposure * header.correction.at(c)));
    }
    Scanlines scanlines(bytes.subspan(header.data_offset), header.inner.count,
                        header.outer.count);
    std::vector<float> rgb;
    for (std::uint32_t line = 0; line < header.outer.count; ++line) {
        for (const Rgbe& texel : scanlines.next()) {
            constexpr int kExponentOfOne = 128 + 8;
            const float step = texel[3] == 0 ? 0 : std::ldexp(1.0F, texel[3] - kExponentOfOne);
            for (std::size_t c = 0; c < 3; ++c) {
                rgb.push_back(static_cast<float>(texel.at(c)) * step * scale.at(c));
            }
        }
    }
    ImageFile file;
    file.image = upright(header, std::move(rgb));
    file.is_xyz = header.format == "32-bit_rle_xyze";
    if (header.exposure != 1) {
        file.warnings.push_back(fmt::format("EXPOSURE {} divided out", header.exposure));
    }
    if (header.correction != std::array<double, 3>{1, 1, 1}) {
        file.warnings.push_back(fmt::format("COLORCORR {} {} {} divided out",
                                            header.correction[0], header.correction[1],
                                            header.correction[2]));
    }
    if (header.primaries && rec709_from(*header.primaries)) {
        file.primaries = *header.primaries;
    } else if (header.states_primaries) {
        file.warnings.emplace_back("PRIMARIES span no colours; taken as Rec. 709");
    }
    return file;
}

}  // namespace relume::light
