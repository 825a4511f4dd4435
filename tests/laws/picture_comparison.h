// Whether two noisy pictures can be the same picture: a test per pixel and channel, corrected
// for their number.
#pragma once

#include "tests/laws/bake_estimate.h"
#include "tests/support/reference_tracer/tracer.h"

#include <Imath/ImathVec.h>

#include <filesystem>
#include <string>
#include <vector>

namespace relume::test {

struct PictureComparison {
    std::vector<Imath::V3d> z;  // difference in standard errors; 0 where both are exact
    double smallest_p = 1;      // over all pixels and channels
    double threshold = 0;       // Šidák: 1 − (1 − significance)^(1/tests)
    std::size_t tests = 0;
    std::size_t rejections = 0;
    double relative_l2 = 0;  // of ours to the reference

    [[nodiscard]] bool is_same() const { return rejections == 0; }
    [[nodiscard]] std::string summary() const;
};

// Welch's t-test per pixel and channel [Welch47], as few seeds make a z-test too eager; Šidák's
// correction over all of them [Subr07 as used by Mitsuba 3]. Differences below `resolution`
// times the pixel are not held against either side: float arithmetic and quadrature.
[[nodiscard]] PictureComparison compare(const Estimate& ours,
                                        const reference::TracedImage& truth,
                                        std::uint32_t truth_samples,
                                        double significance,
                                        double resolution);

// Writes NAME-ours.exr, NAME-reference.exr, NAME-z.exr and PNGs of them into the folder that
// RELUME_EVIDENCE names, or into `evidence/` where the test runs. Returns the folder.
std::filesystem::path write_evidence(const std::string& name,
                                     const Estimate& ours,
                                     const reference::TracedImage& truth,
                                     const PictureComparison& comparison);

}  // namespace relume::test
