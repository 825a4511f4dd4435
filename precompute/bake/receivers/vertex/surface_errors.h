// What interpolation between the vertices of a surface is off by, triangle by triangle.
#pragma once

#include "precompute/bake/receivers/vertex/probe_points.h"
#include "precompute/bake/receivers/vertex/row_store.h"
#include "precompute/bake/receivers/vertex/split_mesh.h"
#include "precompute/bake/receivers/vertex/surface_probe.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

class SurfaceErrors {
  public:
    // Looks at all vertices and measures all triangles of a mesh that has not been split.
    SurfaceErrors(const SplitMesh& mesh, const SurfaceProbe& probe);

    // Looks at what splits have made of the mesh, none of a chord that is new. Rows in the
    // middles of chords become those of the vertices that are made there.
    void measure(const SplitMesh::Changes& changes);

    // What was seen at a vertex of the mesh.
    [[nodiscard]] std::span<const float> row(std::uint32_t vertex) const {
        return rows_.row(row_of_vertex_[vertex]);
    }
    // The integral of the squared error over a triangle.
    [[nodiscard]] double squared(std::uint32_t triangle) const;
    // Of the whole surface: the relative L2 error, which is 0 where there is no light.
    [[nodiscard]] double relative() const { return relative_; }
    [[nodiscard]] double squared_sum() const { return squared_sum_; }
    // What the whole surface answers: the error of 1.
    [[nodiscard]] double energy() const { return energy_; }
    [[nodiscard]] std::uint64_t probes() const { return probes_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    void look_at_vertices();
    void look_at_chords(const std::vector<std::uint32_t>& chords);
    void look_into(const std::vector<std::uint32_t>& triangles);
    void sum_up();
    [[nodiscard]] std::uint32_t places_within(std::uint32_t triangle) const;

    const SplitMesh& mesh_;
    const SurfaceProbe& probe_;
    ProbePoints points_;
    double mean_area_ = 0;  // that one place within is to stand for, at most
    RowStore rows_;
    std::vector<std::uint32_t> row_of_vertex_;
    std::vector<std::uint32_t> row_of_chord_;
    std::vector<float> chord_error2_;
    std::vector<float> inner_error2_;  // by triangle: mean over the places within
    double squared_sum_ = 0;
    double energy_ = 0;
    double relative_ = 0;
    std::uint64_t probes_ = 0;
    std::uint64_t rays_ = 0;
};

}  // namespace relume::bake
