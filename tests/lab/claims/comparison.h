// Methods of one run against each other, in the measures that claims use.
#pragma once

#include "tests/lab/claims/evidence.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

// A number of every image.
struct Measure {
    std::string_view name;
    double (*value)(const Record& record);
};
// Σ_j Area(j) |L_j − L̃_j| over the same of |L_j|, of Haar coefficients: the area of a wavelet
// falls fourfold from band to band. Fig. 6.2 of [Overbeck06T] draws the area-weighted L1 error
// of the lighting, and area is there what wavelets are weighted by.
[[nodiscard]] double area_weighted_l1(const Record& record);
inline constexpr Measure kLightingL1{"area-weighted L1 of the lighting's wavelets",
                                     area_weighted_l1};
// The same norm of radiance on the sphere, where area is solid angle.
inline constexpr Measure kRadianceL1{"L1 of the lighting over the sphere",
                                     [](const Record& record) { return record.lighting_l1; }};
inline constexpr Measure kImageL2{"L2 of the image",
                                  [](const Record& record) { return record.error.l2; }};

// Of a run: the images while the light moves; of these the half that moves slowest and the half
// that moves fastest, in slow-fast-slow; all of them.
enum class Part : std::uint8_t { moving, slow, fast, whole };

// While the light moves. Throws std::invalid_argument when the method did not take part, as do
// all below.
[[nodiscard]] double mean_of(const LightRun& run, const std::string& method, Measure measure);
// The mean of `method` over that of `other` while the light moves.
[[nodiscard]] double ratio_of_means(const LightRun& run,
                                    const std::string& method,
                                    const std::string& other,
                                    Measure measure);
// Part of the images in which `method` errs no more than `other`.
[[nodiscard]] double share_no_worse(const LightRun& run,
                                    const std::string& method,
                                    const std::string& other,
                                    Measure measure,
                                    Part part);
// So many images after the light rests.
[[nodiscard]] double at_rest(const LightRun& run,
                             const std::string& method,
                             std::uint32_t images,
                             Measure measure);

// Terms of NWA by area that leave the mean error `error` while the light moves, on a line
// through the logarithms of those that took part (Evidence::kTermsOfNwa); nothing: more than
// the most.
[[nodiscard]] std::optional<double> nwa_terms_at(const LightRun& run,
                                                 double error,
                                                 Measure measure);

}  // namespace relume::lab
