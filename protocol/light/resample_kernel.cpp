#include "protocol/light/resample_kernel.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "protocol/light/resample_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relume::light::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace resample_row_detail {

// A texel's samples form a quincunx: lines of two, every other line shifted by half the
// distance between its samples.
constexpr std::uint32_t kLines = 4;
constexpr std::uint32_t kSamplesPerLine = 2;
constexpr std::uint32_t kMaxSamples = basis::kMaxFaceResolution * kSamplesPerLine;

// Where a line's first sample stands, as a part of the distance between samples.
constexpr float first_sample(std::uint32_t line) {
    return line % 2 == 0 ? 0.25F : 0.75F;
}

// One line of samples: where each falls into the padded cubemap, how far between its texels.
struct alignas(64) SampleLine {
    std::int32_t offset[kMaxSamples];
    float x_fraction[kMaxSamples];
    float y_fraction[kMaxSamples];
};

// What each sample of a row of texels contributes to its texel; the same for all six faces.
struct alignas(64) SampleWeights {
    float weight[kLines][kMaxSamples];
};

// v of a line of samples, counted from the face's first.
float line_coordinate(std::uint32_t line, std::uint32_t n) {
    const float count = static_cast<float>(n * kLines);
    return (static_cast<float>(line) + 0.5F) * 2 / count - 1;
}

void make_weights(std::uint32_t n, std::uint32_t row, SampleWeights& weights) {
    const hn::ScalableTag<float> d;
    const std::uint32_t samples = n * kSamplesPerLine;
    const auto step = hn::Set(d, 2 / static_cast<float>(samples));
    const auto one = hn::Set(d, 1.0F);
    for (std::uint32_t line = 0; line < kLines; ++line) {
        const float v = line_coordinate(row * kLines + line, n);
        const auto base = hn::Set(d, 1 + v * v);
        for (std::uint32_t s = 0; s < samples; s += static_cast<std::uint32_t>(hn::Lanes(d))) {
            const auto index = hn::Iota(d, static_cast<float>(s) + first_sample(line));
            const auto u = hn::Sub(hn::Mul(index, step), one);
            const auto length_sq = hn::Add(base, hn::Mul(u, u));
            hn::Store(hn::Div(one, hn::Mul(length_sq, hn::Sqrt(length_sq))), d,
                      &weights.weight[line][s]);
        }
    }
    for (std::uint32_t column = 0; column < n; ++column) {
        float sum = 0;
        for (std::uint32_t line = 0; line < kLines; ++line) {
            for (std::uint32_t k = 0; k < kSamplesPerLine; ++k) {
                sum += weights.weight[line][column * kSamplesPerLine + k];
            }
        }
        const float scale = 1 / sum;
        for (std::uint32_t line = 0; line < kLines; ++line) {
            for (std::uint32_t k = 0; k < kSamplesPerLine; ++k) {
                weights.weight[line][column * kSamplesPerLine + k] *= scale;
            }
        }
    }
}

// Rotates a line of sample directions and finds the face and place each pierces, in the
// conventions of basis::face_point_from_direction.
void locate(const ResampleJob& job,
            const RotatedFace& face,
            std::uint32_t row_of_samples,
            SampleLine& line) {
    const float v = line_coordinate(row_of_samples, job.face_resolution);
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::uint32_t samples = job.face_resolution * kSamplesPerLine;
    const Imath::V3f start = face.normal + v * face.v_axis;
    const float first = first_sample(row_of_samples);
    const auto step = hn::Set(d, 2 / static_cast<float>(samples));
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1.0F);
    const auto half_m = hn::Set(d, static_cast<float>(job.inner_resolution) / 2);
    const auto last = hn::Set(d, static_cast<float>(job.inner_resolution) + 0.5F);
    const auto half = hn::Set(d, 0.5F);
    const auto side = hn::Set(di, static_cast<std::int32_t>(job.inner_resolution) + 2);

    for (std::uint32_t s = 0; s < samples; s += static_cast<std::uint32_t>(hn::Lanes(d))) {
        const auto u = hn::Sub(hn::Mul(hn::Iota(d, static_cast<float>(s) + first), step), one);
        const auto x = hn::Add(hn::Set(d, start.x), hn::Mul(u, hn::Set(d, face.u_axis.x)));
        const auto y = hn::Add(hn::Set(d, start.y), hn::Mul(u, hn::Set(d, face.u_axis.y)));
        const auto z = hn::Add(hn::Set(d, start.z), hn::Mul(u, hn::Set(d, face.u_axis.z)));
        const auto ax = hn::Abs(x);
        const auto ay = hn::Abs(y);
        const auto az = hn::Abs(z);
        const auto on_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
        const auto on_y = hn::Ge(ay, az);  // where not on_x
        const auto major_size = hn::Max(ax, hn::Max(ay, az));
        const auto major = hn::IfThenElse(on_x, x, hn::IfThenElse(on_y, y, z));
        const auto negative = hn::Lt(major, zero);
        const auto flip = [&](auto value) {
            return hn::IfThenElse(negative, hn::Neg(value), value);
        };
        // +X (−z, −y), −X (z, −y); ±Y (x, ±z); +Z (x, −y), −Z (−x, −y).
        const auto face_u =
            hn::IfThenElse(on_x, hn::Neg(flip(z)), hn::IfThenElse(on_y, x, flip(x)));
        const auto face_v =
            hn::IfThenElse(on_x, hn::Neg(y), hn::IfThenElse(on_y, flip(z), hn::Neg(y)));
        // Into texels of the padded face: the first inner texel's centre lies at 1.
        const auto place = [&](auto c) {
            const auto p = hn::Add(hn::Mul(hn::Add(hn::Div(c, major_size), one), half_m), half);
            return hn::Min(hn::Max(p, half), last);
        };
        const auto px = place(face_u);
        const auto py = place(face_v);
        const auto ix = hn::ConvertTo(di, px);
        const auto iy = hn::ConvertTo(di, py);
        const auto face_index =
            hn::Add(hn::IfThenElse(on_x, zero,
                                   hn::IfThenElse(on_y, hn::Set(d, 2.0F), hn::Set(d, 4.0F))),
                    hn::IfThenElse(negative, one, zero));
        const auto row = hn::Add(hn::Mul(hn::ConvertTo(di, face_index), side), iy);
        const auto texel = hn::Add(hn::Mul(row, side), ix);
        hn::Store(hn::Add(hn::ShiftLeft<1>(texel), texel), di, &line.offset[s]);
        hn::Store(hn::Sub(px, hn::ConvertTo(d, ix)), d, &line.x_fraction[s]);
        hn::Store(hn::Sub(py, hn::ConvertTo(d, iy)), d, &line.y_fraction[s]);
    }
}

// Colours of a texel, and a fourth value that is not used; of two samples side by side where
// vectors are that long.
using Texels = hn::CappedTag<float, 8>;
inline constexpr std::size_t kTexelFloats = 4;

#if HWY_TARGET == HWY_SCALAR
inline constexpr bool kTwoSideBySide = false;
#else
inline constexpr bool kTwoSideBySide = hn::MaxLanes(Texels()) == 2 * kTexelFloats;

HWY_INLINE hn::Vec<Texels> side_by_side(hn::Vec<hn::Half<Texels>> first,
                                        hn::Vec<hn::Half<Texels>> second) {
    return hn::Combine(Texels(), second, first);
}

HWY_INLINE void store_sum_of_both(hn::Vec<Texels> both, float* HWY_RESTRICT rgb) {
    const hn::Half<Texels> d4;
    hn::Store(hn::Add(hn::LowerHalf(d4, both), hn::UpperHalf(d4, both)), d4, rgb);
}
#endif

// One value for each of the samples at hand, as often as it has colours.
HWY_INLINE hn::Vec<Texels> for_samples(const float* values) {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (kTwoSideBySide) {
        const hn::Half<Texels> d4;
        return side_by_side(hn::Set(d4, values[0]), hn::Set(d4, values[1]));
    }
#endif
    return hn::Set(Texels(), values[0]);
}

HWY_INLINE hn::Vec<Texels> load_texels(const float* texels, const std::int32_t* offsets) {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (kTwoSideBySide) {
        const hn::Half<Texels> d4;
        return side_by_side(hn::LoadU(d4, texels + offsets[0]),
                            hn::LoadU(d4, texels + offsets[1]));
    }
#endif
    return hn::LoadU(Texels(), texels + offsets[0]);
}

// Of the samples from s on.
HWY_INLINE hn::Vec<Texels> bilinear(const float* texels,
                                    std::size_t below,
                                    const SampleLine& line,
                                    std::size_t s) {
    const auto x = for_samples(&line.x_fraction[s]);
    const auto y = for_samples(&line.y_fraction[s]);
    const auto a = load_texels(texels, &line.offset[s]);
    const auto b = load_texels(texels + 3, &line.offset[s]);
    const auto c = load_texels(texels + below, &line.offset[s]);
    const auto e = load_texels(texels + below + 3, &line.offset[s]);
    const auto upper = hn::Add(a, hn::Mul(hn::Sub(b, a), x));
    const auto lower = hn::Add(c, hn::Mul(hn::Sub(e, c), x));
    return hn::Add(upper, hn::Mul(hn::Sub(lower, upper), y));
}

// The mean of a texel's samples: those of even number and those of odd number are added up
// apart and then together, whether or not they are side by side.
HWY_INLINE void mean_of_samples(const float* texels,
                                std::size_t below,
                                const SampleLine (&lines)[kLines],
                                const SampleWeights& weights,
                                std::size_t column,
                                float* HWY_RESTRICT rgb) {
    auto even = hn::Zero(Texels());  // and odd beside it, where both fit
    auto odd = even;
    for (std::uint32_t line = 0; line < kLines; ++line) {
        for (std::uint32_t k = 0; k < kSamplesPerLine; k += 2) {
            const auto weighted = [&](std::size_t sample) HWY_ATTR {
                return hn::Mul(bilinear(texels, below, lines[line], sample),
                               for_samples(&weights.weight[line][sample]));
            };
            const std::size_t s = column * kSamplesPerLine + k;
            even = hn::Add(even, weighted(s));
            if constexpr (!kTwoSideBySide) {
                odd = hn::Add(odd, weighted(s + 1));
            }
        }
    }
#if HWY_TARGET != HWY_SCALAR
    if constexpr (kTwoSideBySide) {
        store_sum_of_both(even, rgb);
        return;
    }
#endif
    hn::Store(hn::Add(even, odd), Texels(), rgb);
}

// A turned line crosses the map at any slope, which no prefetcher of the processor follows.
constexpr std::uint32_t kTexelsAhead = 12;
HWY_INLINE void prefetch_samples(const float* texels,
                                 std::size_t below,
                                 const SampleLine (&lines)[kLines],
                                 std::uint32_t column) {
    for (const SampleLine& line : lines) {
        for (std::uint32_t k = 0; k < kSamplesPerLine; ++k) {
            const float* texel = texels + line.offset[column * kSamplesPerLine + k];
            __builtin_prefetch(texel);
            __builtin_prefetch(texel + below);
        }
    }
}

void resample_face_row(const ResampleJob& job,
                       std::uint32_t face,
                       std::uint32_t row,
                       const SampleWeights& weights) {
    const std::uint32_t n = job.face_resolution;
    SampleLine lines[kLines];
    for (std::uint32_t line = 0; line < kLines; ++line) {
        locate(job, job.faces[face], row * kLines + line, lines[line]);
    }
    const std::size_t below = (std::size_t{job.inner_resolution} + 2) * 3;
    const std::size_t plane = basis::texel_count(n);
    float* out = job.out + (std::size_t{face} * n + row) * n;
    for (std::uint32_t column = 0; column < n; ++column) {
        prefetch_samples(job.texels, below, lines, std::min(column + kTexelsAhead, n - 1));
        alignas(16) float rgb[kTexelFloats];
        for (std::size_t first = 0; first < kTexelFloats; first += hn::Lanes(Texels())) {
            mean_of_samples(job.texels + first, below, lines, weights, column, rgb + first);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = rgb[c] * job.scale[static_cast<int>(c)];
            float& target = out[c * plane + column];
            target = job.accumulate ? target + value : value;
        }
    }
}

}  // namespace resample_row_detail

void resample_row(const ResampleJob& job, std::uint32_t row) {
    resample_row_detail::SampleWeights weights;
    resample_row_detail::make_weights(job.face_resolution, row, weights);
    for (std::uint32_t face = 0; face < basis::kFaceCount; ++face) {
        resample_row_detail::resample_face_row(job, face, row, weights);
    }
}

}  // namespace relume::light::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::light {

HWY_EXPORT(resample_row);

void resample_row(const ResampleJob& job, std::uint32_t row) {
    HWY_DYNAMIC_DISPATCH(resample_row)(job, row);
}

}  // namespace relume::light
#endif  // HWY_ONCE
