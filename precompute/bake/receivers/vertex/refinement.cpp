#include "precompute/bake/receivers/vertex/refinement.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/receivers/vertex/finished_surface.h"
#include "precompute/bake/receivers/vertex/split_mesh.h"
#include "precompute/bake/receivers/vertex/surface_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace relume::bake {
namespace {

void check_options(const RefinementOptions& options) {
    if (options.most_vertices < 3 || options.most_vertices > kMostSurfaceVertices) {
        throw BakeError(fmt::format("vertices are {}, expected 3 to {}", options.most_vertices,
                                    kMostSurfaceVertices));
    }
    if (!(options.target_error >= 0)) {
        throw BakeError(
            fmt::format("target error is {}, expected a number that is not negative",
                        options.target_error));
    }
}

class Refiner {
  public:
    Refiner(SplitMesh& mesh, SurfaceErrors& errors, const RefinementOptions& options)
        : mesh_(mesh), errors_(errors), options_(options), round_of_(mesh.triangles().size()) {}

    void run() {
        while (errors_.relative() > options_.target_error && !is_full_) {
            if (options_.progress) {
                options_.progress(mesh_.vertices().size());
            }
            SplitMesh::Changes changes;
            ++round_;
            first_new_chord_ = mesh_.chords().size();
            for (const std::uint32_t triangle : worst_triangles()) {
                if (is_full_) {
                    break;
                }
                if (round_of_[triangle] != round_) {
                    cut(triangle, changes);
                }
            }
            if (changes.vertices.empty()) {
                return;
            }
            errors_.measure(changes);
        }
    }

  private:
    // Those whose error is at least half of the largest, the largest first; fewer where fewer
    // should do for the target.
    [[nodiscard]] std::vector<std::uint32_t> worst_triangles() const {
        std::vector<std::pair<double, std::uint32_t>> found;
        double largest = 0;
        for (std::uint32_t i = 0; i < mesh_.triangles().size(); ++i) {
            const double error2 = errors_.squared(i);
            if (error2 > largest && mesh_.can_split(mesh_.longest_edge(i))) {
                largest = error2;
            }
        }
        for (std::uint32_t i = 0; i < mesh_.triangles().size(); ++i) {
            const double error2 = errors_.squared(i);
            if (error2 > 0 && error2 >= largest / 2 && mesh_.can_split(mesh_.longest_edge(i))) {
                found.emplace_back(error2, i);
            }
        }
        std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
            return std::pair(-a.first, a.second) < std::pair(-b.first, b.second);
        });
        const double target2 = options_.target_error * options_.target_error * errors_.energy();
        double left = errors_.squared_sum() - target2;
        std::vector<std::uint32_t> worst;
        for (const auto& [error2, triangle] : found) {
            if (left <= 0) {
                break;
            }
            worst.push_back(triangle);
            left -= error2 / 2;  // what cutting it takes away where a shadow's edge passes
        }
        return worst;
    }

    // Splits edges until the triangle's longest has been split, but none that this round has
    // made: nobody has looked at their middles.
    void cut(std::uint32_t triangle, SplitMesh::Changes& changes) {
        const std::uint32_t longest = mesh_.longest_edge(triangle);
        for (std::uint32_t edge = longest + 1; edge != longest;) {
            edge = mesh_.edge_to_split(triangle);
            if (!mesh_.can_split(edge) || mesh_.edges()[edge].chords[0] >= first_new_chord_) {
                return;
            }
            if (mesh_.vertices().size() + mesh_.edges()[edge].chords.size() >
                options_.most_vertices) {
                is_full_ = true;
                return;
            }
            const std::size_t first = changes.triangles.size();
            mesh_.split(edge, changes);
            round_of_.resize(mesh_.triangles().size());
            for (std::size_t i = first; i < changes.triangles.size(); ++i) {
                round_of_[changes.triangles[i]] = round_;
            }
        }
    }

    SplitMesh& mesh_;
    SurfaceErrors& errors_;
    const RefinementOptions& options_;
    std::vector<std::uint32_t> round_of_;  // in which a triangle was made
    std::uint32_t round_ = 0;
    std::size_t first_new_chord_ = 0;
    bool is_full_ = false;
};

}  // namespace

RefinedSurface refine_surface(const scene::Scene& scene,
                              const SurfaceProbe& probe,
                              const RefinementOptions& options) {
    check_options(options);
    SplitMesh mesh(start_surface(scene, options.most_vertices));
    SurfaceErrors errors(mesh, probe);
    Refiner(mesh, errors, options).run();
    std::vector<std::span<const float>> rows;
    for (std::uint32_t vertex = 0; vertex < mesh.vertices().size(); ++vertex) {
        rows.push_back(errors.row(vertex));
    }
    RefinedSurface surface = finished_surface(scene, mesh, rows);
    surface.report.probes = errors.probes();
    surface.report.rays = errors.rays();
    surface.report.interpolation_error = errors.relative();
    surface.report.meets_target = errors.relative() <= options.target_error;
    return surface;
}

}  // namespace relume::bake
