#include "protocol/light/texel_repair.h"

#include "protocol/light/environment_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace relume::light {
namespace {

constexpr float kLargestHalf = 65504.0F;
constexpr std::size_t kMostBadPerHundred = 1;

bool is_finite(const float* texel) {
    return std::isfinite(texel[0]) && std::isfinite(texel[1]) && std::isfinite(texel[2]);
}

// Mean, by colour, of the values around one texel that were finite in the file.
class Neighbourhood {
  public:
    Neighbourhood(const MapImage& image, const std::vector<std::size_t>& bad_texels)
        : image_(image), is_bad_(std::size_t{image.width} * image.height, false) {
        for (const std::size_t texel : bad_texels) {
            is_bad_[texel] = true;
        }
    }

    [[nodiscard]] float mean(std::size_t texel, std::size_t colour) const {
        const auto x = static_cast<std::int64_t>(texel % image_.width);
        const auto y = static_cast<std::int64_t>(texel / image_.width);
        const std::int64_t last_ring = std::max(image_.width, image_.height);
        for (std::int64_t ring = 1; ring <= last_ring; ++ring) {
            double sum = 0;
            std::size_t count = 0;
            for (std::int64_t dy = -ring; dy <= ring; ++dy) {
                // Only the outline: whole rows at the top and the bottom, both ends between.
                const std::int64_t step = std::abs(dy) == ring ? 1 : 2 * ring;
                for (std::int64_t dx = -ring; dx <= ring; dx += step) {
                    if (contains(x + dx, y + dy)) {
                        const auto at = static_cast<std::size_t>(
                            (y + dy) * static_cast<std::int64_t>(image_.width) + x + dx);
                        if (!is_bad_[at]) {
                            sum += double{image_.rgb[at * 3 + colour]};
                            ++count;
                        }
                    }
                }
            }
            if (count > 0) {
                return static_cast<float>(sum / static_cast<double>(count));
            }
        }
        return 0;
    }

  private:
    [[nodiscard]] bool contains(std::int64_t x, std::int64_t y) const {
        return x >= 0 && y >= 0 && x < image_.width && y < image_.height;
    }

    const MapImage& image_;
    std::vector<bool> is_bad_;
};

// How many of the image's texels were changed when `change` was applied to every value.
template <typename Change>
std::size_t count_changed(MapImage& image, Change change) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        bool changed = false;
        for (std::size_t c = 0; c < 3; ++c) {
            changed |= change(image.rgb[i + c]);
        }
        count += changed ? 1 : 0;
    }
    return count;
}

}  // namespace

std::vector<std::string> replace_non_finite(MapImage& image) {
    std::vector<std::string> warnings;
    std::vector<std::size_t> bad;
    float brightest = kLargestHalf;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        if (!is_finite(&image.rgb[i])) {
            bad.push_back(i / 3);
            continue;
        }
        brightest = std::max({brightest, image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
    }
    const std::size_t texels = image.rgb.size() / 3;
    if (bad.size() > 1 && bad.size() * 100 > texels * kMostBadPerHundred) {
        const std::string found = fmt::format("{} of {} texels", bad.size(), texels);
        const std::string expected = fmt::format("at most {} in 100", kMostBadPerHundred);
        throw EnvironmentError(
            fmt::format("{} are NaN or infinite, expected {}", found, expected), found,
            expected);
    }
    if (!bad.empty()) {
        const Neighbourhood around(image, bad);
        std::size_t overflowed = 0;
        for (const std::size_t texel : bad) {
            bool has_infinity = false;
            for (std::size_t c = 0; c < 3; ++c) {
                float& value = image.rgb[texel * 3 + c];
                if (value == std::numeric_limits<float>::infinity()) {
                    value = brightest;
                    has_infinity = true;
                } else if (!std::isfinite(value)) {
                    value = around.mean(texel, c);
                }
            }
            overflowed += has_infinity ? 1 : 0;
        }
        if (overflowed > 0) {
            warnings.push_back(
                fmt::format("{} infinite texels set to {}", overflowed, brightest));
        }
        if (overflowed < bad.size()) {
            warnings.push_back(fmt::format("{} NaN texels set to the mean of their neighbours",
                                           bad.size() - overflowed));
        }
    }
    return warnings;
}

std::vector<std::string> limit_texels(MapImage& image) {
    std::vector<std::string> warnings;
    float lowest = 0;
    const std::size_t negative = count_changed(image, [&](float& value) {
        lowest = std::min(lowest, value);
        const bool changed = value < 0;
        value = changed ? 0 : value;
        return changed;
    });
    if (negative > 0) {
        warnings.push_back(
            fmt::format("{} negative texels set to 0, the lowest being {}", negative, lowest));
    }
    const std::size_t too_bright = count_changed(image, [](float& value) {
        const bool changed = value > kMaxTexelRadiance;
        value = std::min(value, kMaxTexelRadiance);
        return changed;
    });
    if (too_bright > 0) {
        warnings.push_back(fmt::format("{} texels brighter than {} set to that", too_bright,
                                       kMaxTexelRadiance));
    }
    return warnings;
}

}  // namespace relume::light
