#include "tests/lab/cpca/seams.h"

#include <array>
#include <cmath>

namespace relume::lab {
namespace {

struct Jumps {
    double exact = 0;
    double coded = 0;
    double added = 0;
    std::size_t edges = 0;
};

double ratio_of_rms(double border, double inner, const std::array<Jumps, 2>& jumps) {
    if (jumps[0].edges == 0 || jumps[1].edges == 0 || inner <= 0) {
        return 1;
    }
    return std::sqrt(border / static_cast<double>(jumps[1].edges) /
                     (inner / static_cast<double>(jumps[0].edges)));
}

}  // namespace

SeamFigures measure_seams(const VertexRows& rows,
                          std::span<const std::uint32_t> cluster_of,
                          std::span<const float> exact,
                          std::span<const float> coded,
                          std::size_t lights,
                          std::size_t first,
                          std::size_t last) {
    std::array<Jumps, 2> jumps;  // within, across borders
    for (std::uint32_t v = 0; v < rows.vertex_count(); ++v) {
        for (std::uint32_t i = rows.edges.first[v]; i < rows.edges.first[v + 1]; ++i) {
            const std::uint32_t u = rows.edges.neighbours[i];
            if (u <= v) {
                continue;
            }
            Jumps& own = jumps[cluster_of[u] != cluster_of[v] ? 1 : 0];
            ++own.edges;
            for (std::size_t plane = 0; plane < rows.planes[v]; ++plane) {
                for (std::size_t light = first; light < last; ++light) {
                    const std::size_t a = (rows.first[v] + plane) * lights + light;
                    const std::size_t b = (rows.first[u] + plane) * lights + light;
                    const double was = double{exact[a]} - double{exact[b]};
                    const double is = double{coded[a]} - double{coded[b]};
                    own.exact += was * was;
                    own.coded += is * is;
                    own.added += (is - was) * (is - was);
                }
            }
        }
    }
    SeamFigures figures{.border_edges = jumps[1].edges, .inner_edges = jumps[0].edges};
    figures.added = ratio_of_rms(jumps[1].added, jumps[0].added, jumps);
    const double own = ratio_of_rms(jumps[1].exact, jumps[0].exact, jumps);
    figures.shown = own > 0 ? ratio_of_rms(jumps[1].coded, jumps[0].coded, jumps) / own : 1;
    return figures;
}

}  // namespace relume::lab
