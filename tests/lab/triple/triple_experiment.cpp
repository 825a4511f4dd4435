#include "tests/lab/triple/triple_experiment.h"

#include "protocol/base/timing/stopwatch.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/tripling/texel_blocks.h"
#include "server/engine/kernels/open_mixture.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::lab {
namespace {

constexpr double kLeastSeconds = 0.25;  // that a rate is measured over

// The i-th of `count` vertices that are spread over all that are seen.
std::size_t spread(const SeenSurface& surface, std::size_t i, std::size_t count) {
    return i * surface.seen().size() / count;
}

double seconds_of_image(const SeenSurface& surface, const TripleWay& way) {
    double least = 1e30;
    for (int round = 0; round < 3; ++round) {
        const timing::Stopwatch watch;
        (void)integrate_all(surface, way);
        least = std::min(least, watch.seconds());
    }
    return least;
}

// What tabulation and interpolation leave off, by the material itself at some vertices.
double table_error(const SeenSurface& surface,
                   const TabulatedMaterial& material,
                   const TripleLight& light,
                   const std::vector<engine::Radiance>& exact,
                   std::size_t count) {
    std::vector<engine::Radiance> found(count);
    std::vector<engine::Radiance> truth(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const SeenVertex& seen = surface.seen()[spread(surface, i, count)];
        const std::vector<float> texels = tripling::values_in_blocks(
            surface.face_resolution(), material.at(seen.normal, seen.reflection));
        truth[i] = engine::sum_open_products(surface.bits_in_blocks(seen.vertex),
                                             light.block_planes(), texels.data());
        found[i] = exact[spread(surface, i, count)];
    });
    return relative_l2(found, truth);
}

std::vector<GridPoint> grid_of_terms(const SeenSurface& surface,
                                     const TabulatedMaterial& material,
                                     const TripleLight& light,
                                     const std::vector<engine::Radiance>& exact) {
    std::vector<GridPoint> grid;
    for (std::size_t f = 0; f < kMaterialFractions.size(); ++f) {
        for (const double of_light : kLightFractions) {
            const tripling::SquareSet terms = light.largest(of_light);
            const TripleWay way = sublinear_way(surface, material, f, light, terms);
            const timing::Stopwatch watch;
            const auto radiance = integrate_all(surface, way);
            grid.push_back({.light = of_light,
                            .material = kMaterialFractions[f],
                            .error = relative_l2(radiance, exact),
                            .seconds = watch.seconds()});
        }
    }
    return grid;
}

// Slope of log y over log x by least squares.
double log_slope(const std::vector<TermPoint>& points, std::size_t first) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const auto count = static_cast<double>(points.size() - first);
    for (std::size_t i = first; i < points.size(); ++i) {
        const double x = std::log(static_cast<double>(points[i].terms));
        const double y = std::log(points[i].microseconds);
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

// Of the calling thread: what others do on the machine does not count.
double processor_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Microseconds of a processor a call of `integrate(i)` for i < count, over and over.
template <typename Integrate>
double microseconds_of(std::size_t count, const Integrate& integrate) {
    for (std::size_t i = 0; i < count; ++i) {
        integrate(i);
    }
    std::size_t calls = 0;
    const double begin = processor_seconds();
    double spent = 0;
    while (spent < kLeastSeconds) {
        for (std::size_t i = 0; i < count; ++i) {
            integrate(i);
        }
        calls += count;
        spent = processor_seconds() - begin;
    }
    return 1e6 * spent / static_cast<double>(calls);
}

}  // namespace

std::vector<engine::Radiance> integrate_all(const SeenSurface& surface, const TripleWay& way) {
    return integrate_all(surface.seen().size(), way);
}

std::vector<engine::Radiance> integrate_all(std::size_t count, const TripleWay& way) {
    std::vector<engine::Radiance> radiance(count);
    tbb::enumerable_thread_specific<IntegrateAt> ways(way.make);
    tbb::parallel_for(std::size_t{0}, radiance.size(),
                      [&](std::size_t i) { radiance[i] = ways.local()(i); });
    return radiance;
}

double relative_l2(const std::vector<engine::Radiance>& a,
                   const std::vector<engine::Radiance>& truth) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            difference += std::pow(double{a[i][c]} - double{truth[i][c]}, 2);
            norm += std::pow(double{truth[i][c]}, 2);
        }
    }
    return norm > 0 ? std::sqrt(difference / norm) : 0;
}

double vertices_per_second(const SeenSurface& surface, const TripleWay& way, std::size_t most) {
    const std::size_t count = std::min(most, surface.seen().size());
    const IntegrateAt integrate = way.make();
    engine::Radiance sum{};
    const double microseconds = microseconds_of(count, [&](std::size_t i) {
        const engine::Radiance radiance = integrate(spread(surface, i, count));
        sum[0] += radiance[0];
    });
    return std::isfinite(sum[0]) ? 1e6 / microseconds : 0;
}

MaterialFindings measure_material(const SeenSurface& surface,
                                  const TabulatedMaterial& material,
                                  const TripleLight& light,
                                  std::size_t peer_vertices) {
    MaterialFindings findings;
    findings.material = material.words();
    findings.entries_seconds = material.seconds();
    findings.wavelet_bytes =
        static_cast<double>(material.field(kPaperMaterial).lobes.front().byte_count());
    findings.run_bytes = static_cast<double>(material.runs().byte_count());
    findings.sparsity = material.sparsity(kPaperMaterial);
    const tripling::SquareSet terms = light.largest(kLightFractions[kPaperLight]);
    const TripleWay sublinear = sublinear_way(surface, material, kPaperMaterial, light, terms);
    const TripleWay bits = bits_way(surface, material, material.runs(), light);
    const auto exact =
        integrate_all(surface, bits_way(surface, material, material.texels(), light));
    findings.error_sublinear = relative_l2(integrate_all(surface, sublinear), exact);
    findings.error_bits = relative_l2(integrate_all(surface, bits), exact);
    findings.table_error = table_error(surface, material, light, exact,
                                       std::min(peer_vertices, surface.seen().size()));
    findings.seconds_sublinear = seconds_of_image(surface, sublinear);
    findings.seconds_bits = seconds_of_image(surface, bits);
    for (const TripleWay& way :
         {sublinear, bits, decompressed_way(surface, material, kPaperMaterial, light),
          published_way(surface, material, kPaperMaterial, light, terms),
          pixels_way(surface, material, light, peer_vertices)}) {
        findings.ways.push_back(way.name);
        findings.vertices_per_second.push_back(
            vertices_per_second(surface, way, peer_vertices));
    }
    findings.grid = grid_of_terms(surface, material, light, exact);
    return findings;
}

TermCurve time_against_terms(const SeenSurface& surface,
                             const TabulatedMaterial& material,
                             const TripleLight& light) {
    constexpr std::size_t kVertices = 12;
    const std::uint32_t n = surface.face_resolution();
    const std::size_t count = std::min(kVertices, surface.seen().size());
    std::vector<std::vector<float>> coefficients(count);
    std::vector<std::uint32_t> vertices(count);
    tripling::TexelStore texels(n);
    std::vector<engine::Radiance> truth(count);
    for (std::size_t i = 0; i < count; ++i) {
        // Not all from the first corner of the image.
        const SeenVertex& seen = surface.seen()[spread(surface, 2 * i + 1, 2 * count)];
        vertices[i] = seen.vertex;
        coefficients[i] = material.at(seen.normal, seen.reflection);
        texels.append(tripling::values_in_blocks(n, coefficients[i]), 0);
        basis::haar_forward_cubemap(n, coefficients[i]);
        const std::array one{engine::WeightedTexels{.weight = 1, .function = texels.view(i)}};
        truth[i] = engine::sum_open_mixture(surface.bits_in_blocks(vertices[i]),
                                            light.block_planes(), one);
    }
    TermCurve curve;
    curve.microseconds_bits = microseconds_of(count, [&](std::size_t i) {
        const std::array one{engine::WeightedTexels{.weight = 1, .function = texels.view(i)}};
        (void)engine::sum_open_mixture(surface.bits_in_blocks(vertices[i]),
                                       light.block_planes(), one);
    });
    engine::TripleWorkspace workspace(n);
    const std::size_t wavelets = basis::texel_count(n) - basis::kFaceCount;
    for (std::size_t terms = 4; terms <= wavelets; terms *= 2) {
        tripling::WaveletStore store(n);
        for (const auto& of_vertex : coefficients) {
            store.append(tripling::SparseWavelets(
                tripling::largest_squares(n, of_vertex, terms, tripling::TermOrder::by_size)
                    .with_ancestors(),
                of_vertex));
        }
        const tripling::SquareSet light_terms =
            light.largest(static_cast<double>(terms) / static_cast<double>(wavelets));
        std::vector<engine::Radiance> found(count);
        const double microseconds = microseconds_of(count, [&](std::size_t i) {
            const std::array one{
                engine::WeightedWavelets{.weight = 1, .function = store.view(i)}};
            engine::multiply_visibility(surface.wavelets().point(vertices[i]), one,
                                        light_terms.words(), workspace);
            found[i] = engine::sum_light(light.table(), workspace);
        });
        curve.points.push_back(
            {.terms = terms, .microseconds = microseconds, .error = relative_l2(found, truth)});
    }
    curve.slope = log_slope(curve.points, curve.points.size() / 2);
    return curve;
}

}  // namespace relume::lab
