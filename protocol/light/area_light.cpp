#include "protocol/light/area_light.h"

#include "protocol/basis/cubemap.h"
#include "protocol/light/disc_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace relume::light {
namespace {

constexpr std::uint32_t kSamplesPerSide = 4;
constexpr std::uint32_t kPatchSide = 4;  // of texels; a face resolution is a multiple of it

struct Covered {
    std::size_t texel;
    float coverage;
};

// Collects the texels that a disc covers, by tiles first.
class Rasteriser {
  public:
    // The edge is as wide as two samples are apart where they are farthest, so that the
    // coverage of a texel follows the disc smoothly.
    Rasteriser(const Imath::V3f& direction, float angular_radius, std::uint32_t n)
        : direction_(direction),
          n_(n),
          disc_(chord_from_angle(angular_radius),
                2 * 2 / static_cast<float>(n * kSamplesPerSide)) {}

    [[nodiscard]] std::vector<Covered> run() {
        for (std::uint32_t face = 0; face < basis::kFaceCount; ++face) {
            for (std::uint32_t row = 0; row < n_; row += kPatchSide) {
                for (std::uint32_t column = 0; column < n_; column += kPatchSide) {
                    visit_patch({static_cast<basis::Face>(face), row, column});
                }
            }
        }
        return std::move(covered_);
    }

    // ∫ coverage dω over the texels found.
    [[nodiscard]] double solid_angle() const { return solid_angle_; }

  private:
    // No point of a square of the cube's surface is farther from its centre's direction.
    [[nodiscard]] float reach(float side_in_texels) const {
        return std::numbers::sqrt2_v<float> * side_in_texels / static_cast<float>(n_);
    }

    void visit_patch(const basis::Texel& first) {
        constexpr float kHalf = static_cast<float>(kPatchSide) / 2;
        const Imath::V3f centre = basis::direction_from_texel(n_, first, kHalf, kHalf);
        const float distance = (centre - direction_).length();
        if (distance > disc_.outer_radius() + reach(kPatchSide)) {
            return;
        }
        for (std::uint32_t row = first.row; row < first.row + kPatchSide; ++row) {
            for (std::uint32_t column = first.column; column < first.column + kPatchSide;
                 ++column) {
                visit_texel({first.face, row, column});
            }
        }
    }

    void visit_texel(const basis::Texel& texel) {
        const float distance = (basis::direction_from_texel(n_, texel) - direction_).length();
        float coverage = 0;
        if (distance + reach(1) <= disc_.inner_radius()) {
            coverage = 1;
        } else if (distance - reach(1) < disc_.outer_radius()) {
            coverage = sample(texel);
        }
        if (coverage > 0) {
            covered_.push_back({basis::index_from_texel(n_, texel), coverage});
            solid_angle_ +=
                double{coverage} * basis::solid_angle_sr(n_, texel.row, texel.column);
        }
    }

    [[nodiscard]] float sample(const basis::Texel& texel) const {
        float sum = 0;
        float weight_sum = 0;
        const float step = 2 / static_cast<float>(n_ * kSamplesPerSide);
        for (std::uint32_t i = 0; i < kSamplesPerSide; ++i) {
            const auto line = static_cast<float>(texel.row * kSamplesPerSide + i);
            for (std::uint32_t k = 0; k < kSamplesPerSide; ++k) {
                const auto sample_column =
                    static_cast<float>(texel.column * kSamplesPerSide + k);
                const Imath::V3f point = basis::cube_point_from_face_point(
                    {texel.face, (sample_column + 0.5F) * step - 1, (line + 0.5F) * step - 1});
                const float length = point.length();
                const float weight = 1 / (length * length * length);
                sum += weight * disc_.at((point / length - direction_).length());
                weight_sum += weight;
            }
        }
        return sum / weight_sum;
    }

    Imath::V3f direction_;
    std::uint32_t n_;
    DiscCoverage disc_;
    std::vector<Covered> covered_;
    double solid_angle_ = 0;
};

}  // namespace

double solid_angle_sr(const AreaLight& light) {
    const double half_sine = std::sin(double{light.angular_radius_radians} / 2);
    return 4 * std::numbers::pi * half_sine * half_sine;
}

void add_area_light(const AreaLight& light, LightCubemap& cubemap) {
    Rasteriser rasteriser(light.direction.normalized(), light.angular_radius_radians,
                          cubemap.face_resolution);
    const std::vector<Covered> covered = rasteriser.run();
    // What sampling got wrong about the disc's size is put right here, which is what makes the
    // energy independent of where the disc stands.
    const auto correction =
        static_cast<float>(solid_angle_sr(light) / rasteriser.solid_angle());
    const auto planes = cubemap.planes();
    for (std::size_t colour = 0; colour < planes.size(); ++colour) {
        const float radiance = light.radiance[static_cast<int>(colour)] * correction;
        for (const Covered& texel : covered) {
            planes[colour][texel.texel] += radiance * texel.coverage;
        }
    }
}

}  // namespace relume::light
