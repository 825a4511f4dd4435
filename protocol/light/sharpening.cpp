#include "protocol/light/sharpening.h"

#include "protocol/basis/cubemap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace relume::light {
namespace {

constexpr std::size_t kColours = 3;
using Partners = std::array<std::uint32_t, 4>;  // indices of texels

// Those to the left, to the right, above and below; past an edge, where the face's plane goes
// on.
Partners partners_of(const basis::Texel& texel, std::uint32_t m, std::uint32_t stride) {
    const float step = 2 / static_cast<float>(m);
    const float u = (static_cast<float>(texel.column) + 0.5F) * step - 1;
    const float v = (static_cast<float>(texel.row) + 0.5F) * step - 1;
    const float away = static_cast<float>(stride) * step;
    const auto index_at = [&](float at_u, float at_v) {
        const basis::Texel at = basis::texel_from_direction(
            m, basis::cube_point_from_face_point({.face = texel.face, .u = at_u, .v = at_v}));
        return static_cast<std::uint32_t>(basis::index_from_texel(m, at));
    };
    return {index_at(u - away, v), index_at(u + away, v), index_at(u, v - away),
            index_at(u, v + away)};
}

// Of one colour.
class Exchange {
  public:
    Exchange(const std::vector<Partners>& partners,
             const std::vector<float>& solid_angles_sr,
             float strength)
        : partners_(partners), solid_angles_sr_(solid_angles_sr), strength_(strength) {}

    [[nodiscard]] std::vector<float> sharpened(const std::vector<float>& radiance) const {
        // What each texel is asked for, and then which part of it that it can give.
        std::vector<float> part(radiance.size(), 0.0F);
        for_each_pair(radiance, [&](std::size_t to, std::size_t from, float energy) {
            part[energy > 0 ? from : to] += std::abs(energy);
        });
        for (std::size_t i = 0; i < part.size(); ++i) {
            const float held = radiance[i] * solid_angle_sr(i);
            part[i] = part[i] > held ? held / part[i] : 1;
        }
        std::vector<float> gain(radiance.size(), 0.0F);
        for_each_pair(radiance, [&](std::size_t to, std::size_t from, float energy) {
            const float given = energy * part[energy > 0 ? from : to];
            gain[to] += given;
            gain[from] -= given;
        });
        std::vector<float> result(radiance.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = std::max(0.0F, radiance[i] + gain[i] / solid_angle_sr(i));
        }
        return result;
    }

  private:
    [[nodiscard]] float solid_angle_sr(std::size_t i) const {
        return solid_angles_sr_[i % solid_angles_sr_.size()];
    }

    // Calls visit(to, from, energy) from both ends of a pair, for half of it each.
    template <typename Visit>
    void for_each_pair(const std::vector<float>& radiance, Visit visit) const {
        for (std::size_t i = 0; i < partners_.size(); ++i) {
            for (const std::uint32_t j : partners_[i]) {
                const float mean_sr = (solid_angle_sr(i) + solid_angle_sr(j)) / 2;
                visit(i, j, strength_ / 2 * mean_sr * (radiance[i] - radiance[j]));
            }
        }
    }

    const std::vector<Partners>& partners_;
    const std::vector<float>& solid_angles_sr_;  // of one face
    float strength_;
};

}  // namespace

void sharpen(const PaddedCubemap& cubemap,
             std::uint32_t m,
             std::uint32_t stride,
             float strength) {
    const std::size_t count = basis::texel_count(m);
    std::vector<Partners> partners(count);
    std::vector<float> solid_angles_sr(std::size_t{m} * m);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const basis::Texel texel = basis::texel_from_index(m, i);
        partners[i] = partners_of(texel, m, stride);
        if (i < solid_angles_sr.size()) {
            solid_angles_sr[i] =
                static_cast<float>(basis::solid_angle_sr(m, texel.row, texel.column));
        }
    });
    const Exchange exchange(partners, solid_angles_sr, strength);
    tbb::parallel_for(std::size_t{0}, kColours, [&](std::size_t colour) {
        const auto value = [&](std::size_t i) -> float& {
            const basis::Texel texel = basis::texel_from_index(m, i);
            return cubemap.at(texel.face, static_cast<int>(texel.row),
                              static_cast<int>(texel.column))[colour];
        };
        std::vector<float> radiance(count);
        for (std::size_t i = 0; i < count; ++i) {
            radiance[i] = value(i);
        }
        radiance = exchange.sharpened(radiance);
        for (std::size_t i = 0; i < count; ++i) {
            value(i) = radiance[i];
        }
    });
}

}  // namespace relume::light
