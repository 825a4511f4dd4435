#include "protocol/light/source_splat.h"

#include "protocol/basis/cubemap.h"
#include "protocol/light/map_geometry.h"
#include "protocol/light/padded_cubemap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace relume::light {

using Layout = EnvironmentMap::Layout;

namespace {

// Bands of source rows are collected side by side, each into a cubemap of its own.
constexpr std::size_t kBandBytes = std::size_t{128} << 20;
constexpr std::size_t kMostBands = 8;
constexpr std::size_t kChannels = 4;

class Splatter {
  public:
    Splatter(const EnvironmentMap& source,
             const EnvironmentMap::Level& level,
             std::uint32_t m,
             float part_side)
        : layout_(source.layout()),
          turn_(turn_of_centre(source.centre())),
          level_(level),
          m_(m),
          part_side_(part_side) {}

    [[nodiscard]] std::uint32_t row_count() const {
        return face_count(layout_) * level_.height;
    }

    void splat_row(std::uint32_t row, const PaddedCubemap& bins) const {
        const std::uint32_t face = row / level_.height;
        const std::uint32_t y = row % level_.height;
        const float height = static_cast<float>(level_.height);
        const float width = static_cast<float>(level_.width);
        const std::uint32_t parts_down = parts(texel_side_radians(layout_, level_.height));
        const std::uint32_t parts_across = parts_across_row(y);
        const float area = 1 / (height * width * static_cast<float>(parts_down) *
                                static_cast<float>(parts_across));
        const float* texels = &level_.rgb[std::size_t{row} * level_.width * 3];
        for (std::uint32_t i = 0; i < parts_down; ++i) {
            const float part_y = (static_cast<float>(y) + middle(i, parts_down)) / height;
            for (std::uint32_t x = 0; x < level_.width; ++x) {
                const float* texel = texels + std::size_t{x} * 3;
                for (std::uint32_t k = 0; k < parts_across; ++k) {
                    const float part_x =
                        (static_cast<float>(x) + middle(k, parts_across)) / width;
                    const float solid_angle =
                        area * solid_angle_density_sr(layout_, part_x, part_y);
                    add({.face = face, .x = part_x, .y = part_y}, texel, solid_angle, bins);
                }
            }
        }
    }

  private:
    static float middle(std::uint32_t i, std::uint32_t count) {
        return (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    }

    [[nodiscard]] std::uint32_t parts(float side_radians) const {
        return std::max(1U, static_cast<std::uint32_t>(std::ceil(side_radians / part_side_)));
    }

    [[nodiscard]] std::uint32_t parts_across_row(std::uint32_t y) const {
        if (layout_ != Layout::lat_long) {
            return parts(texel_side_radians(layout_, level_.height));
        }
        const float height = static_cast<float>(level_.height);
        const float pi = std::numbers::pi_v<float>;
        // Where the row is widest: on the equator if it crosses it, else at the nearer edge.
        const float from_above = 0.5F - static_cast<float>(y + 1) / height;
        const float from_below = static_cast<float>(y) / height - 0.5F;
        const float nearest = std::max({0.0F, from_above, from_below});
        return parts(2 * pi * std::cos(pi * nearest) / static_cast<float>(level_.width));
    }

    void add(const MapPoint& point,
             const float* rgb,
             float solid_angle,
             const PaddedCubemap& bins) const {
        if (solid_angle <= 0) {
            return;
        }
        const basis::FacePoint place = basis::face_point_from_direction(
            product(turn_, direction_from_map_point(layout_, point)));
        const float half = static_cast<float>(m_) / 2;
        const float x = (place.u + 1) * half - 0.5F;
        const float y = (place.v + 1) * half - 0.5F;
        const float left = std::floor(x);
        const float top = std::floor(y);
        const float fx = x - left;
        const float fy = y - top;
        float* upper = bins.at(place.face, static_cast<int>(top), static_cast<int>(left));
        float* lower = upper + std::size_t{m_ + 2} * kChannels;
        const std::array<float, kChannels> energy{rgb[0] * solid_angle, rgb[1] * solid_angle,
                                                  rgb[2] * solid_angle, solid_angle};
        for (std::size_t c = 0; c < kChannels; ++c) {
            const float above = energy[c] * (1 - fy);
            const float below = energy[c] * fy;
            upper[c] += above * (1 - fx);
            upper[c + kChannels] += above * fx;
            lower[c] += below * (1 - fx);
            lower[c + kChannels] += below * fx;
        }
    }

    Layout layout_;
    Imath::M33f turn_;
    const EnvironmentMap::Level& level_;
    std::uint32_t m_;
    float part_side_;
};

}  // namespace

std::vector<float> splat_source(const EnvironmentMap& source, std::uint32_t m) {
    const float part_side = 2.0F / static_cast<float>(m) / 2.0F;
    // Coarser levels hold the same energy: take the coarsest whose texels are parts already.
    std::size_t chosen = 0;
    while (chosen + 1 < source.levels().size() &&
           texel_side_radians(source.layout(), source.levels()[chosen + 1].height) <=
               part_side) {
        ++chosen;
    }
    const Splatter splatter(source, source.levels()[chosen], m, part_side);

    const std::size_t values = PaddedCubemap::value_count(m, kChannels);
    const std::size_t band_count =
        std::clamp<std::size_t>(kBandBytes / (values * sizeof(float)), 1, kMostBands);
    std::vector<std::vector<float>> bands(band_count);
    const std::size_t rows = splatter.row_count();
    tbb::parallel_for(std::size_t{0}, band_count, [&](std::size_t band) {
        bands[band].assign(values, 0.0F);
        const PaddedCubemap bins(bands[band], m, kChannels);
        const std::size_t end = rows * (band + 1) / band_count;
        for (std::size_t row = rows * band / band_count; row < end; ++row) {
            splatter.splat_row(static_cast<std::uint32_t>(row), bins);
        }
    });
    std::vector<float>& sum = bands.front();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, values, 65536),
                      [&](const auto& range) {
                          for (std::size_t band = 1; band < band_count; ++band) {
                              for (std::size_t i = range.begin(); i != range.end(); ++i) {
                                  sum[i] += bands[band][i];
                              }
                          }
                      });
    PaddedCubemap(sum, m, kChannels).fold_borders();
    return std::move(sum);
}

}  // namespace relume::light
