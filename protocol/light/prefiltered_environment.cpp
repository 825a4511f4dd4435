#include "protocol/light/prefiltered_environment.h"

#include "protocol/basis/cubemap.h"
#include "protocol/light/low_pass.h"
#include "protocol/light/padded_cubemap.h"
#include "protocol/light/sharpening.h"
#include "protocol/light/source_splat.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace relume::light {
namespace {

// As many texels as rotation_resample.h takes samples, and a low-pass 1.5 of them wide:
// README.md shows that no lattice of samples then favours one place over another by more than 2
// %.
constexpr std::uint32_t kInnerPerOuter = 4;
constexpr float kSigmaInnerTexels = 1.5F;
constexpr std::size_t kChannels = 3;

std::uint32_t inner_resolution_from(std::uint32_t n) {
    if (!basis::is_face_resolution(n)) {
        throw std::invalid_argument(fmt::format(
            "face resolution to prefilter for is {}, expected a power of two from {} to {}", n,
            basis::kMinFaceResolution, basis::kMaxFaceResolution));
    }
    return kInnerPerOuter * n;
}

// (1 − r²/R²)³ over a disc has variance R²/10 along either axis.
float kernel_radius_from(std::uint32_t m) {
    return std::sqrt(10.0F) * kSigmaInnerTexels * 2 / static_cast<float>(m);
}

}  // namespace

PrefilteredEnvironment::PrefilteredEnvironment(std::shared_ptr<const EnvironmentMap> source,
                                               std::uint32_t face_resolution,
                                               float sharpening)
    : source_(std::move(source)),
      face_resolution_(face_resolution),
      inner_resolution_(inner_resolution_from(face_resolution)) {
    const std::uint32_t m = inner_resolution_;
    const LowPass low_pass(splat_source(*source_, m), m, kernel_radius_from(m));
    texels_.assign(PaddedCubemap::value_count(m, kChannels) + 1, 0.0F);
    const PaddedCubemap padded(texels_, m, kChannels);
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, basis::kFaceCount * m), [&](const auto& range) {
            for (std::uint32_t line = range.begin(); line != range.end(); ++line) {
                basis::Texel texel{static_cast<basis::Face>(line / m), line % m, 0};
                float* out = padded.at(texel.face, static_cast<int>(texel.row), 0);
                for (; texel.column < m; ++texel.column) {
                    const Imath::V3f mean = low_pass.filter(texel);
                    out = std::copy_n(&mean.x, kChannels, out);
                }
            }
        });
    if (sharpening > 0) {
        sharpen(padded, m, kInnerPerOuter, sharpening);
    }
    padded.fill_borders();
}

}  // namespace relume::light
