#include "precompute/bake/rows/reflection.h"

#include "precompute/scene/mirror_lobe.h"
#include "protocol/basis/cpu_clones.h"
#include "protocol/basis/cubemap.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace relume::bake {
namespace {

struct Normals {
    Imath::V3f shading;
    Imath::V3f geometric;
};

// Vector irradiance of the part of a texel that is above both horizons.
Imath::V3d clipped_irradiance(const LightTexels& texels,
                              std::size_t place,
                              const Normals& normals,
                              TexelDetail detail) {
    if (detail == TexelDetail::one_of_many) {
        const Imath::V3f centroid(texels.direction_x()[place], texels.direction_y()[place],
                                  texels.direction_z()[place]);
        const float height =
            std::min(centroid.dot(normals.shading), centroid.dot(normals.geometric));
        return Imath::V3d(height > 0 ? centroid * texels.irradiance()[place]
                                     : Imath::V3f(0, 0, 0));
    }
    SphericalPolygon polygon = texels.polygon(place);
    polygon.clip(Imath::V3d(normals.shading));
    polygon.clip(Imath::V3d(normals.geometric));
    return polygon.vector_irradiance();
}

// Calls whole(packet) for packets with a part above both horizons, after telling each of their
// texels apart: whole[lane] is 1 above both horizons, 0 below either, and crossing(place) is
// called for those between.
template <typename Whole, typename Crossing, typename Below>
void for_each_packet(const LightTexels& texels,
                     const Normals& normals,
                     Whole whole,
                     Crossing crossing,
                     Below below) {
    const float* x = texels.direction_x().data();
    const float* y = texels.direction_y().data();
    const float* z = texels.direction_z().data();
    const Imath::V3f& s = normals.shading;
    const Imath::V3f& g = normals.geometric;
    for (std::size_t packet = 0; packet < texels.packet_count(); ++packet) {
        const std::size_t first = packet * kPacketSize;
        const Imath::V3f& middle = texels.packet_direction(packet);
        const float reach = texels.packet_sine_radius(packet);
        const float lowest = std::min(middle.dot(s), middle.dot(g));
        if (lowest < -reach) {
            below(first);
            continue;
        }
        whole(first);
        if (lowest > reach) {
            continue;
        }
        const float radius = texels.sine_radius(packet);
        for (std::size_t place = first; place < first + kPacketSize; ++place) {
            const float height = std::min(s.x * x[place] + s.y * y[place] + s.z * z[place],
                                          g.x * x[place] + g.y * y[place] + g.z * z[place]);
            if (height < radius) {
                crossing(place, height < -radius);
            }
        }
    }
}

RELUME_CPU_CLONES void cosines(const Imath::V3f& normal,
                               const float* x,
                               const float* y,
                               const float* z,
                               const float* irradiance,
                               float* out) {
    for (std::size_t i = 0; i < kPacketSize; ++i) {
        out[i] = (normal.x * x[i] + normal.y * y[i] + normal.z * z[i]) * irradiance[i];
    }
}

void reflect_diffuse(const LightTexels& texels,
                     const Normals& normals,
                     TexelDetail detail,
                     Reflection& out) {
    const float* x = texels.direction_x().data();
    const float* y = texels.direction_y().data();
    const float* z = texels.direction_z().data();
    const float* irradiance = texels.irradiance().data();
    const Imath::V3f s = normals.shading * std::numbers::inv_pi_v<float>;
    float* grey = out.grey.data();
    for_each_packet(
        texels, normals,
        [&](std::size_t first) {
            cosines(s, x + first, y + first, z + first, irradiance + first, grey + first);
        },
        [&](std::size_t place, bool is_below) {
            grey[place] = is_below ? 0.0F
                                   : std::max(0.0F, s.dot(Imath::V3f(clipped_irradiance(
                                                        texels, place, normals, detail))));
        },
        [&](std::size_t first) { std::fill_n(grey + first, kPacketSize, 0.0F); });
}

// How a texel's integral is to be found.
// `coarse` and `fine` are grids of midpoints.
enum class TexelRule : std::uint8_t { centroid, coarse, fine, sampled };

class TexelRules {
  public:
    TexelRules(const LightTexels& texels, const scene::SurfacePoint& point, TexelDetail detail)
        : smooth_(detail == TexelDetail::sole_point ? kSmooth : kSmoothOfMany),
          width_(scene::lobe_width(point)),
          texel_(2.0F / static_cast<float>(texels.face_resolution())),
          mirror_(scene::mirror_direction(point)) {}

    // Whether the lobe is smooth across every texel within `radius` of a direction.
    [[nodiscard]] bool is_smooth_around(const Imath::V3f& direction, float radius) const {
        const float nearest = (direction - mirror_).length() - 2 * radius;
        return texel_ < smooth_ * std::max(width_, 0.5F * nearest);
    }

    [[nodiscard]] TexelRule rule(const Imath::V3f& direction) const {
        // Texels per scale on which the lobe changes here: its width, or further out its
        // distance from the peak.
        const float away = (direction - mirror_).length();
        const float coarseness = texel_ / std::max(width_, 0.5F * away);
        constexpr float kCoarseResolves = 0.6F;
        constexpr float kFineResolves = 2.5F;
        return coarseness < smooth_           ? TexelRule::centroid
               : coarseness < kCoarseResolves ? TexelRule::coarse
               : coarseness < kFineResolves   ? TexelRule::fine
                                              : TexelRule::sampled;
    }

  private:
    static constexpr float kSmooth = 0.2F;
    static constexpr float kSmoothOfMany = 1.2F;

    float smooth_;
    float width_;
    float texel_;
    Imath::V3f mirror_;
};

// The sixteen parts of one texel by the midpoints of a grid of kSide×kSide.
template <std::uint32_t kSide>
SplitTexel grid_texel(const LightTexels& texels,
                      const scene::SurfacePoint& point,
                      std::size_t place) {
    constexpr std::size_t kCount = std::size_t{kSide} * kSide;
    constexpr float kCell = 1.0F / kSide;
    const float texel = 2.0F / static_cast<float>(texels.face_resolution());
    std::array<std::array<float, kCount>, 3> direction;
    std::array<std::array<float, kCount>, 3> value;
    std::array<float, kCount> solid_angle;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const Imath::V3f cube =
            texels.cube_point(place, (static_cast<float>(i % kSide) + 0.5F) * kCell,
                              (static_cast<float>(i / kSide) + 0.5F) * kCell);
        const float inverse = 1.0F / cube.length();
        for (int axis = 0; axis < 3; ++axis) {
            direction[static_cast<std::size_t>(axis)][i] = cube[axis] * inverse;
        }
        // dω = du dv / |cube point|³.
        solid_angle[i] = texel * texel * kCell * kCell * inverse * inverse * inverse;
    }
    point.reflect({direction[0], direction[1], direction[2]}, {value[0], value[1], value[2]});
    SplitTexel split{.place = static_cast<std::uint32_t>(place)};
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const std::size_t part = std::size_t{i / kSide * 4 / kSide} * 4 + i % kSide * 4 / kSide;
        for (std::size_t c = 0; c < 3; ++c) {
            split.rgb[c][part] += value[c][i] * solid_angle[i];
        }
    }
    return split;
}

// Roberts' R3 sequence: any number of points, evenly spread over the unit cube.
std::array<float, 3> even_point(std::uint32_t i) {
    constexpr std::array<double, 3> kSteps{0.8191725133961645, 0.6710436067037893,
                                           0.5497004779019703};
    std::array<float, 3> point{};
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
        const double along = 0.5 + kSteps[axis] * i;
        const double whole = static_cast<double>(static_cast<std::uint32_t>(along));
        point[axis] = std::min(static_cast<float>(along - whole), 0x1.fffffep-1F);
    }
    return point;
}

// Texels in which the lobe peaks too sharply for any grid: the lobe's own samples, counted
// where they fall. Whatever its width, its energy is kept. `peaks` have their places set.
void sample_peaks(const LightTexels& texels,
                  const scene::SurfacePoint& point,
                  std::span<SplitTexel> peaks) {
    constexpr std::uint32_t kSamples = 2048;
    const std::uint32_t n = texels.face_resolution();
    const auto side = static_cast<float>(n);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const auto [lobe, u, v] = even_point(i);
        const auto sample = point.sample(lobe, {u, v});
        if (sample.pdf <= 0) {
            continue;
        }
        const basis::FacePoint at = basis::face_point_from_direction(sample.wi);
        const basis::Texel texel = basis::texel_from_direction(n, sample.wi);
        const std::size_t place =
            texels.place_from_texel_index(basis::index_from_texel(n, texel));
        const auto found =
            std::find_if(peaks.begin(), peaks.end(),
                         [place](const SplitTexel& peak) { return peak.place == place; });
        if (found == peaks.end()) {
            continue;
        }
        const auto quarter = [side](float coordinate, std::uint32_t whole) {
            const float offset = (coordinate + 1) * 0.5F * side - static_cast<float>(whole);
            return static_cast<std::size_t>(std::clamp(offset * 4, 0.0F, 3.0F));
        };
        const std::size_t part = quarter(at.v, texel.row) * 4 + quarter(at.u, texel.column);
        for (std::size_t c = 0; c < 3; ++c) {
            found->rgb[c][part] += sample.weight[static_cast<int>(c)] / kSamples;
        }
    }
}

void set_sum(const SplitTexel& split, Reflection& out) {
    for (std::size_t c = 0; c < 3; ++c) {
        out.rgb[c][split.place] =
            std::accumulate(split.rgb[c].begin(), split.rgb[c].end(), 0.0F);
    }
}

void split_texels(const LightTexels& texels,
                  const scene::SurfacePoint& point,
                  TexelDetail detail,
                  Reflection& out) {
    const TexelRules rules(texels, point, detail);
    std::vector<SplitTexel> peaks;
    for (std::size_t place = 0; place < texels.size(); ++place) {
        const std::size_t packet = place / kPacketSize;
        if (place % kPacketSize == 0 &&
            rules.is_smooth_around(texels.packet_direction(packet),
                                   texels.packet_sine_radius(packet))) {
            place += kPacketSize - 1;
            continue;
        }
        if (out.projected[place] <= 0) {
            continue;
        }
        switch (rules.rule({texels.direction_x()[place], texels.direction_y()[place],
                            texels.direction_z()[place]})) {
            case TexelRule::centroid:
                break;
            case TexelRule::coarse:
                set_sum(grid_texel<4>(texels, point, place), out);
                break;
            case TexelRule::fine:
                out.split.push_back(grid_texel<8>(texels, point, place));
                break;
            case TexelRule::sampled:
                peaks.push_back({.place = static_cast<std::uint32_t>(place)});
                break;
        }
    }
    if (!peaks.empty()) {
        sample_peaks(texels, point, peaks);
        out.split.insert(out.split.end(), peaks.begin(), peaks.end());
    }
    for (const SplitTexel& split : out.split) {
        set_sum(split, out);
    }
}

void reflect_glossy(const LightTexels& texels,
                    const scene::SurfacePoint& point,
                    const Normals& normals,
                    TexelDetail detail,
                    Reflection& out) {
    const std::array<std::span<const float>, 3> centroid{
        texels.direction_x(), texels.direction_y(), texels.direction_z()};
    const auto set_direction = [&](std::size_t place, const Imath::V3f& direction) {
        for (int axis = 0; axis < 3; ++axis) {
            out.direction[static_cast<std::size_t>(axis)][place] = direction[axis];
        }
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::copy(centroid[axis].begin(), centroid[axis].end(), out.direction[axis].begin());
    }
    std::copy(texels.solid_angle_sr().begin(), texels.solid_angle_sr().end(),
              out.projected.begin());
    for_each_packet(
        texels, normals, [](std::size_t) {},
        [&](std::size_t place, bool is_below) {
            const Imath::V3f clipped(is_below
                                         ? Imath::V3d(0, 0, 0)
                                         : clipped_irradiance(texels, place, normals, detail));
            out.projected[place] = clipped.length();
            if (out.projected[place] > 0) {
                set_direction(place, clipped / out.projected[place]);
            }
        },
        [&](std::size_t first) { std::fill_n(&out.projected[first], kPacketSize, 0.0F); });
    for (std::size_t first = 0; first < texels.size(); first += kPacketSize) {
        const bool any = std::any_of(&out.projected[first], &out.projected[first] + kPacketSize,
                                     [](float solid_angle) { return solid_angle > 0; });
        const auto part = [&](auto& planes, std::size_t c) {
            return std::span<float>(planes[c]).subspan(first, kPacketSize);
        };
        if (!any) {
            for (std::size_t c = 0; c < 3; ++c) {
                std::fill_n(&out.rgb[c][first], kPacketSize, 0.0F);
            }
            continue;
        }
        point.reflect({part(out.direction, 0), part(out.direction, 1), part(out.direction, 2)},
                      {part(out.rgb, 0), part(out.rgb, 1), part(out.rgb, 2)});
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = first; i < first + kPacketSize; ++i) {
                out.rgb[c][i] *= out.projected[i];
            }
        }
    }
    split_texels(texels, point, detail, out);
}

}  // namespace

void reflect_light(const LightTexels& texels,
                   const scene::SurfacePoint& point,
                   Reflection& reflection,
                   TexelDetail detail) {
    const Normals normals{point.shading.normal, point.geometric_normal};
    reflection.is_diffuse = point.bsdf.is_diffuse();
    reflection.split.clear();
    if (reflection.is_diffuse) {
        reflection.grey.resize(texels.size());
        reflect_diffuse(texels, normals, detail, reflection);
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        reflection.rgb[c].resize(texels.size());
        reflection.direction[c].resize(texels.size());
    }
    reflection.projected.resize(texels.size());
    reflect_glossy(texels, point, normals, detail, reflection);
}

}  // namespace relume::bake
