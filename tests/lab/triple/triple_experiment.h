// How fast and how exactly light times visibility times material is integrated at the vertices
// that a camera sees, in several ways.
#pragma once

#include "tests/lab/triple/peers.h"
#include "tests/lab/triple/seen_surface.h"
#include "tests/lab/triple/tabulated_material.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace relume::lab {

// Of the coefficients, as [Ng04 fig. 4] has them; the last but one is the paper's setting.
inline const std::vector<double> kMaterialFractions{1e-4, 1e-3, 5e-3, 2e-2};
inline const std::vector<double> kLightFractions{1e-4, 1e-3, 5e-3, 1e-2, 1};
// "typically with about 0.5% of the lighting terms and 0.1% of the BRDF terms" [Ng04 §8.3]
inline constexpr std::size_t kPaperMaterial = 1;
inline constexpr std::size_t kPaperLight = 2;

// Radiances of all seen vertices, with the threads of the calling arena.
[[nodiscard]] std::vector<engine::Radiance> integrate_all(const SeenSurface& surface,
                                                          const TripleWay& way);
// Of the first `count` vertices that the way has.
[[nodiscard]] std::vector<engine::Radiance> integrate_all(std::size_t count,
                                                          const TripleWay& way);
// ‖a − truth‖/‖truth‖ over colours and vertices.
[[nodiscard]] double relative_l2(const std::vector<engine::Radiance>& a,
                                 const std::vector<engine::Radiance>& truth);
// Vertices a second of a processor's time, of vertices spread over those that are seen.
[[nodiscard]] double vertices_per_second(const SeenSurface& surface,
                                         const TripleWay& way,
                                         std::size_t most);

struct GridPoint {
    double light = 0;     // fraction of terms
    double material = 0;  // likewise
    double error = 0;     // of the exact integral of the same tabulated material
    double seconds = 0;   // an image
};

struct MaterialFindings {
    std::string material;
    double entries_seconds = 0;  // to tabulate it in all ways
    double wavelet_bytes = 0;    // at the paper's setting
    double run_bytes = 0;
    double sparsity = 0;           // at the paper's setting
    double seconds_sublinear = 0;  // an image, all threads
    double seconds_bits = 0;
    double error_sublinear = 0;  // of the exact integral
    double error_bits = 0;
    double table_error = 0;  // of the exact integral against the material that is not tabulated
    std::vector<std::string> ways;
    std::vector<double> vertices_per_second;  // of each way, on one thread
    std::vector<GridPoint> grid;
};

// `peer_vertices`: so many vertices are timed and compared without tables.
[[nodiscard]] MaterialFindings measure_material(const SeenSurface& surface,
                                                const TabulatedMaterial& material,
                                                const TripleLight& light,
                                                std::size_t peer_vertices);

// Time and error against the number of terms of both, the exact material at a few vertices
// [Ng04 fig. 3].
struct TermPoint {
    std::size_t terms = 0;
    double microseconds = 0;  // a vertex, one thread
    double error = 0;
};
struct TermCurve {
    std::vector<TermPoint> points;
    double slope = 0;              // of log time over log terms, over the upper half
    double microseconds_bits = 0;  // the same integrals over texels
};
[[nodiscard]] TermCurve time_against_terms(const SeenSurface& surface,
                                           const TabulatedMaterial& material,
                                           const TripleLight& light);

}  // namespace relume::lab
