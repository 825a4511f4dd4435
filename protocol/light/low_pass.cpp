#include "protocol/light/low_pass.h"

#include "protocol/light/padded_cubemap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relume::light {
namespace {

constexpr std::size_t kChannels = 4;
constexpr std::size_t kVectorPadding = 16;

// Rows or columns [begin, end) of a face.
struct Interval {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

}  // namespace

LowPass::LowPass(std::vector<float> bins, std::uint32_t m, float radius)
    : m_(m), radius_(radius), sin_radius_(std::sin(radius)) {
    const std::size_t count = basis::texel_count(m);
    for (std::vector<float>& plane : planes_) {
        plane.assign(count + kVectorPadding, 0.0F);
    }
    const PaddedCubemap padded(bins, m, kChannels);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const basis::Texel texel = basis::texel_from_index(m, i);
            const Imath::V3f direction = basis::direction_from_texel(m, texel);
            const float* bin = padded.at(texel.face, static_cast<int>(texel.row),
                                         static_cast<int>(texel.column));
            for (int c = 0; c < 3; ++c) {
                planes_[c][i] = direction[c];
            }
            for (std::size_t c = 0; c < kChannels; ++c) {
                planes_[3 + c][i] = bin[c];
            }
        }
    });
}

Imath::V3f LowPass::filter(const basis::Texel& texel) const {
    const Imath::V3f centre = basis::direction_from_texel(m_, texel);
    float sum[kChannels] = {};
    for (std::uint32_t face = 0; face < basis::kFaceCount; ++face) {
        add_face(centre, static_cast<basis::Face>(face), sum);
    }
    return {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]};
}

void LowPass::add_face(const Imath::V3f& centre, basis::Face face, float sum[4]) const {
    const Imath::V3f normal = basis::cube_point_from_face_point({face, 0, 0});
    const float height = centre.dot(normal);
    // A face reaches 54.74° from its axis.
    constexpr float kFaceReach = 0.9554F;
    if (height < std::cos(kFaceReach + radius_)) {
        return;
    }
    // Which rows or columns the kernel may touch: projected to the plane of one axis and
    // the normal, its cap lies between two tangents.
    const auto interval = [&](const Imath::V3f& axis) -> Interval {
        const float along = centre.dot(axis - normal);
        const float sin_sq = sin_radius_ * sin_radius_;
        const float denominator = height * height - sin_sq;
        if (height <= 0 || denominator <= 0) {
            return {0, m_};
        }
        const float middle = along * height;
        const float spread =
            sin_radius_ * std::sqrt(std::max(0.0F, along * along + denominator));
        const float half = static_cast<float>(m_) / 2;
        const auto texel = [&](float u) {
            return std::clamp((u / denominator + 1) * half, 0.0F, static_cast<float>(m_));
        };
        return {static_cast<std::uint32_t>(texel(middle - spread)),
                static_cast<std::uint32_t>(std::ceil(texel(middle + spread)))};
    };
    const Interval columns = interval(basis::cube_point_from_face_point({face, 1, 0}));
    const Interval rows = interval(basis::cube_point_from_face_point({face, 0, 1}));
    if (columns.begin >= columns.end || rows.begin >= rows.end) {
        return;
    }
    LowPassWindow window{.planes = {},
                         .row_stride = m_,
                         .first_row = rows.begin,
                         .end_row = rows.end,
                         .first_column = columns.begin,
                         .end_column = columns.end,
                         .inverse_radius_sq = 1 / (radius_ * radius_)};
    const std::size_t first = basis::index_from_texel(m_, {face, 0, 0});
    for (std::size_t p = 0; p < std::size(planes_); ++p) {
        window.planes[p] = &planes_[p][first];
    }
    add_window(window, centre, sum);
}

}  // namespace relume::light
