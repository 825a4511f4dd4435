#include "precompute/bake/reflection.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::bake {
namespace {

struct Normals {
    Imath::V3f shading;
    Imath::V3f geometric;
};

Imath::V3d clipped_irradiance(const LightTexels& texels,
                              std::size_t place,
                              const Normals& normals) {
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

void reflect_diffuse(const LightTexels& texels, const Normals& normals, Reflection& out) {
    const float* x = texels.direction_x().data();
    const float* y = texels.direction_y().data();
    const float* z = texels.direction_z().data();
    const float* irradiance = texels.irradiance().data();
    const Imath::V3f s = normals.shading * std::numbers::inv_pi_v<float>;
    float* grey = out.grey.data();
    for_each_packet(
        texels, normals,
        [&](std::size_t first) {
            for (std::size_t i = first; i < first + kPacketSize; ++i) {
                grey[i] = (s.x * x[i] + s.y * y[i] + s.z * z[i]) * irradiance[i];
            }
        },
        [&](std::size_t place, bool is_below) {
            grey[place] = is_below ? 0.0F
                                   : std::max(0.0F, s.dot(Imath::V3f(clipped_irradiance(
                                                        texels, place, normals))));
        },
        [&](std::size_t first) { std::fill_n(grey + first, kPacketSize, 0.0F); });
}

// How wide the glossy lobe is, in radians of the light's direction.
float lobe_width(const scene::Bsdf& bsdf) {
    constexpr float kHalfVectorDoubles = 2.0F;
    return bsdf.model() == scene::BsdfModel::ggx ? kHalfVectorDoubles * bsdf.alpha()
                                                 : std::sqrt(2.0F / (bsdf.exponent() + 2.0F));
}

// Parts per side of a texel, a multiple of four; 0 where the centroid alone will do.
class TexelSplitter {
  public:
    TexelSplitter(const LightTexels& texels, const scene::SurfacePoint& point)
        : width_(lobe_width(point.bsdf)),
          texel_(2.0F / static_cast<float>(texels.face_resolution())),
          mirror_(point.shading.to_world({-point.wo.x, -point.wo.y, point.wo.z})) {}

    [[nodiscard]] std::uint32_t parts_per_side(const Imath::V3f& direction) const {
        constexpr float kPartsPerWidth = 3.0F;
        constexpr float kSmoothEnough = 1.5F;
        constexpr float kMost = 32.0F;
        const float away = (direction - mirror_).length();
        const float parts = kPartsPerWidth * texel_ / std::max(width_, 0.5F * away);
        if (parts < kSmoothEnough) {
            return 0;
        }
        return 4 * static_cast<std::uint32_t>(std::ceil(std::min(parts, kMost) / 4));
    }

  private:
    float width_;
    float texel_;
    Imath::V3f mirror_;
};

// The sixteen parts of one texel, each by a grid of equal parts of its own.
SplitTexel split_texel(const LightTexels& texels,
                       const scene::SurfacePoint& point,
                       std::size_t place,
                       std::uint32_t per_side) {
    const std::size_t count = std::size_t{per_side} * per_side;
    const auto cell = 1.0F / static_cast<float>(per_side);
    const float texel = 2.0F / static_cast<float>(texels.face_resolution());
    std::array<std::vector<float>, 3> direction;
    std::array<std::vector<float>, 3> value;
    for (int axis = 0; axis < 3; ++axis) {
        direction[static_cast<std::size_t>(axis)].resize(count);
        value[static_cast<std::size_t>(axis)].resize(count);
    }
    std::vector<float> solid_angle(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Imath::V3f cube =
            texels.cube_point(place, (static_cast<float>(i % per_side) + 0.5F) * cell,
                              (static_cast<float>(i / per_side) + 0.5F) * cell);
        const float inverse = 1.0F / cube.length();
        for (int axis = 0; axis < 3; ++axis) {
            direction[static_cast<std::size_t>(axis)][i] = cube[axis] * inverse;
        }
        // dω = du dv / |cube point|³.
        solid_angle[i] = texel * texel * cell * cell * inverse * inverse * inverse;
    }
    point.reflect({direction[0], direction[1], direction[2]}, {value[0], value[1], value[2]});
    SplitTexel split{.place = static_cast<std::uint32_t>(place)};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t part =
            std::size_t{(i / per_side) * 4 / per_side} * 4 + (i % per_side) * 4 / per_side;
        for (std::size_t c = 0; c < 3; ++c) {
            split.rgb[c][part] += value[c][i] * solid_angle[i];
        }
    }
    return split;
}

void reflect_glossy(const LightTexels& texels,
                    const scene::SurfacePoint& point,
                    const Normals& normals,
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
            const Imath::V3f clipped(is_below ? Imath::V3d(0, 0, 0)
                                              : clipped_irradiance(texels, place, normals));
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
    const TexelSplitter splitter(texels, point);
    for (std::size_t place = 0; place < texels.size(); ++place) {
        if (out.projected[place] <= 0) {
            continue;
        }
        const std::uint32_t per_side = splitter.parts_per_side(
            {centroid[0][place], centroid[1][place], centroid[2][place]});
        if (per_side == 0) {
            continue;
        }
        const SplitTexel split = split_texel(texels, point, place, per_side);
        for (std::size_t c = 0; c < 3; ++c) {
            out.rgb[c][place] = 0;
            for (const float value : split.rgb[c]) {
                out.rgb[c][place] += value;
            }
        }
        out.split.push_back(split);
    }
}

}  // namespace

void reflect_light(const LightTexels& texels,
                   const scene::SurfacePoint& point,
                   Reflection& reflection) {
    const Normals normals{point.shading.normal, point.geometric_normal};
    reflection.is_diffuse = point.bsdf.is_diffuse();
    reflection.split.clear();
    if (reflection.is_diffuse) {
        reflection.grey.resize(texels.size());
        reflect_diffuse(texels, normals, reflection);
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        reflection.rgb[c].resize(texels.size());
        reflection.direction[c].resize(texels.size());
    }
    reflection.projected.resize(texels.size());
    reflect_glossy(texels, point, normals, reflection);
}

}  // namespace relume::bake
