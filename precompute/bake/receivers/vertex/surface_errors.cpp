#include "precompute/bake/receivers/vertex/surface_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>

namespace relume::bake {
namespace {

// The whole surface is looked at in about as many places within triangles, so that a small
// shadow in the middle of a large triangle is not missed.
constexpr double kPlacesWithin = 2048;
constexpr std::uint32_t kMostSide = 8;  // of places within one triangle: squared

using Corners = std::array<std::span<const float>, 3>;

// The squared distance of a row from what three others make with these weights.
float squared_distance(std::span<const float> row,
                       const Corners& corners,
                       const std::array<float, 3>& weights) {
    float sum = 0;
    float length2 = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const float off = row[i] - (corners[0][i] * weights[0] + corners[1][i] * weights[1] +
                                    corners[2][i] * weights[2]);
        sum += off * off;
        length2 += row[i] * row[i];
    }
    // Equal rows differ by rounding once they have been weighed and added up.
    constexpr float kRounding = 1e-11F;
    return sum > kRounding * length2 ? sum : 0;
}

float squared_length(std::span<const float> row) {
    return std::inner_product(row.begin(), row.end(), row.begin(), 0.0F);
}

// Middles of the side² triangles that a triangle is cut into: weights of its second and third
// corner.
std::vector<Imath::V2f> middles_within(std::uint32_t side) {
    std::vector<Imath::V2f> middles;
    const auto at = [side](std::uint32_t i, float offset) {
        return (static_cast<float>(i) + offset) / static_cast<float>(side);
    };
    for (std::uint32_t i = 0; i < side; ++i) {
        for (std::uint32_t j = 0; i + j < side; ++j) {
            middles.emplace_back(at(i, 1.0F / 3), at(j, 1.0F / 3));
            if (i + j + 1 < side) {
                middles.emplace_back(at(i, 2.0F / 3), at(j, 2.0F / 3));
            }
        }
    }
    return middles;
}

// Calls body(i) for i < count from many threads.
template <typename Body>
void for_each_in_parallel(std::size_t count, Body body) {
    constexpr std::size_t kGrain = 8;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              body(i);
                          }
                      });
}

}  // namespace

SurfaceErrors::SurfaceErrors(const SplitMesh& mesh, const SurfaceProbe& probe)
    : mesh_(mesh), probe_(probe), points_(mesh), rows_(probe.row_size()) {
    std::vector<std::uint32_t> triangles(mesh.triangles().size());
    std::iota(triangles.begin(), triangles.end(), 0U);
    double area = 0;
    for (const std::uint32_t triangle : triangles) {
        area += mesh.area(triangle);
    }
    mean_area_ = area / kPlacesWithin;
    std::vector<std::uint32_t> chords(mesh.chords().size());
    std::iota(chords.begin(), chords.end(), 0U);
    look_at_vertices();
    look_at_chords(chords);
    look_into(triangles);
    sum_up();
}

void SurfaceErrors::measure(const SplitMesh::Changes& changes) {
    row_of_vertex_.resize(mesh_.vertices().size());
    for (const auto& [chord, vertex] : changes.vertices) {
        row_of_vertex_[vertex] = row_of_chord_[chord];
    }
    std::vector<std::uint32_t> triangles = changes.triangles;
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    look_at_chords(changes.chords);
    look_into(triangles);
    sum_up();
}

void SurfaceErrors::look_at_vertices() {
    const std::size_t count = mesh_.vertices().size();
    row_of_vertex_.resize(count);
    std::iota(row_of_vertex_.begin(), row_of_vertex_.end(), 0U);
    rows_.grow(count);
    std::atomic<std::uint64_t> rays{0};
    for_each_in_parallel(count, [&](std::size_t i) {
        const auto vertex = static_cast<std::uint32_t>(i);
        rays += probe_.write_row(points_.at_start_vertex(vertex), rows_.row(i));
    });
    rays_ += rays;
    probes_ += count;
}

void SurfaceErrors::look_at_chords(const std::vector<std::uint32_t>& chords) {
    const std::size_t first = rows_.count();
    rows_.grow(first + chords.size());
    row_of_chord_.resize(mesh_.chords().size());
    chord_error2_.resize(mesh_.chords().size());
    std::atomic<std::uint64_t> rays{0};
    for_each_in_parallel(chords.size(), [&](std::size_t i) {
        const std::uint32_t chord = chords[i];
        row_of_chord_[chord] = static_cast<std::uint32_t>(first + i);
        const std::span<float> row = rows_.row(first + i);
        rays += probe_.write_row(points_.in_chord(chord), row);
        const auto& [a, b] = mesh_.chords()[chord].vertices;
        const std::span<const float> start = rows_.row(row_of_vertex_[a]);
        chord_error2_[chord] = squared_distance(
            row, {start, rows_.row(row_of_vertex_[b]), start}, {0.5F, 0.5F, 0});
    });
    rays_ += rays;
    probes_ += chords.size();
}

std::uint32_t SurfaceErrors::places_within(std::uint32_t triangle) const {
    const double side = std::ceil(std::sqrt(mesh_.area(triangle) / mean_area_));
    return static_cast<std::uint32_t>(std::clamp(side, 1.0, double{kMostSide}));
}

void SurfaceErrors::look_into(const std::vector<std::uint32_t>& triangles) {
    inner_error2_.resize(mesh_.triangles().size());
    std::array<std::vector<Imath::V2f>, kMostSide + 1> middles;
    for (std::uint32_t side = 1; side <= kMostSide; ++side) {
        middles[side] = middles_within(side);
    }
    std::atomic<std::uint64_t> rays{0};
    std::atomic<std::uint64_t> probes{0};
    for_each_in_parallel(triangles.size(), [&](std::size_t i) {
        const std::uint32_t triangle = triangles[i];
        const auto& vertices = mesh_.triangles()[triangle].vertices;
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = rows_.row(row_of_vertex_[vertices[k]]);
        }
        const std::vector<Imath::V2f>& places = middles[places_within(triangle)];
        std::vector<float> row(probe_.row_size());
        float sum = 0;
        for (const Imath::V2f& at : places) {
            rays += probe_.write_row(points_.in_triangle(triangle, at), row);
            sum += squared_distance(row, corners, {1 - at.x - at.y, at.x, at.y});
        }
        probes += places.size();
        inner_error2_[triangle] = sum / static_cast<float>(places.size());
    });
    rays_ += rays;
    probes_ += probes;
}

// The rule of degree three of corners, middles of sides and the centroid, in which corners
// weigh nothing here: nothing is off there. Places within stand for the centroid.
double SurfaceErrors::squared(std::uint32_t triangle) const {
    constexpr double kSide = 8.0 / 60;
    constexpr double kCentroid = 27.0 / 60;
    double sum = kCentroid * inner_error2_[triangle];
    for (const std::uint32_t chord : mesh_.triangles()[triangle].chords) {
        sum += kSide * chord_error2_[chord];
    }
    return mesh_.area(triangle) * sum;
}

void SurfaceErrors::sum_up() {
    std::vector<float> length2(mesh_.vertices().size());
    for (std::size_t i = 0; i < length2.size(); ++i) {
        length2[i] = squared_length(rows_.row(row_of_vertex_[i]));
    }
    squared_sum_ = 0;
    energy_ = 0;
    for (std::uint32_t i = 0; i < mesh_.triangles().size(); ++i) {
        squared_sum_ += squared(i);
        const auto& [a, b, c] = mesh_.triangles()[i].vertices;
        energy_ += mesh_.area(i) * (double{length2[a]} + length2[b] + length2[c]) / 3;
    }
    relative_ = energy_ > 0 ? std::sqrt(squared_sum_ / energy_) : 0;
}

}  // namespace relume::bake
