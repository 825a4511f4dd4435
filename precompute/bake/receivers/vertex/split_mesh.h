// A surface whose edges can be split, one at a time, and which stays conforming.
//
// Whatever meets at an edge is split together: the faces of a crease, the two sides of a sheet,
// all triangles of an edge that more than two share. An edge is split only where it is the
// longest of every triangle at it. Then the angles of triangles stay bounded away from zero
// however often they are split [Rivara84], and no vertex ever lies inside another's edge.
//
// An edge along which the normal turns is long: lengths are those of positions and normals
// together, in six dimensions [Levy12]. Between the rings of a thin tube highlights pass, and
// its triangles are split around the tube before they are along it.
#pragma once

#include "precompute/bake/receivers/vertex/start_surface.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

class SplitMesh {
  public:
    struct Triangle {
        std::array<std::uint32_t, 3> vertices{};
        std::array<std::uint32_t, 3> chords{};  // chord k joins vertices k and k + 1
        std::uint32_t start = 0;                // of start().triangles: the one it lies on
        // Of its corners: weights of the second and third vertex of the start triangle.
        std::array<Imath::V2f, 3> barycentrics{};
    };
    // Two vertices that triangles join along an edge. An edge has several where a crease, a
    // border of materials or a second side passes.
    struct Chord {
        std::array<std::uint32_t, 2> vertices{};
        std::uint32_t edge = 0;
    };
    struct Edge {
        std::array<std::uint32_t, 2> points{};
        double length2 = 0;  // between its points
        double turn2 = 0;    // of the chord along which the normal turns most, as a length
        std::vector<std::uint32_t> triangles;
        std::vector<std::uint32_t> chords;
    };
    // What splitting an edge did.
    struct Changes {
        struct MadeVertex {
            std::uint32_t chord = 0;  // in whose middle it lies, and which is no more
            std::uint32_t vertex = 0;
        };
        std::vector<MadeVertex> vertices;
        std::vector<std::uint32_t> triangles;  // new, or smaller than before
        std::vector<std::uint32_t> chords;     // new
    };

    explicit SplitMesh(StartSurface start);

    [[nodiscard]] const StartSurface& start() const { return start_; }
    [[nodiscard]] const std::vector<Imath::V3f>& points() const { return points_; }
    [[nodiscard]] const std::vector<StartVertex>& vertices() const { return vertices_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
    // Those that are no more among them.
    [[nodiscard]] const std::vector<Chord>& chords() const { return chords_; }
    [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
    [[nodiscard]] const Imath::V3f& position(std::uint32_t vertex) const {
        return points_[vertices_[vertex].point];
    }

    [[nodiscard]] std::uint32_t longest_edge(std::uint32_t triangle) const;
    // An edge that is the longest of every triangle at it, and has to be split before the
    // triangle's longest is, or is that.
    [[nodiscard]] std::uint32_t edge_to_split(std::uint32_t triangle) const;
    // False where the edge is so short that its middle is hardly a place of its own.
    [[nodiscard]] bool can_split(std::uint32_t edge) const;
    // `edge` is one of edge_to_split. It makes as many vertices as the edge has chords.
    void split(std::uint32_t edge, Changes& changes);

    // Weights of the second and third vertex of a start triangle to what lies there: positions
    // in the plane of the scene's triangle, normals interpolated as the scene's are.
    [[nodiscard]] Imath::V3f position_at(std::uint32_t start,
                                         const Imath::V2f& barycentric) const;
    [[nodiscard]] Imath::V3f normal_at(std::uint32_t start,
                                       const Imath::V2f& barycentric) const;
    [[nodiscard]] double area(std::uint32_t triangle) const;

  private:
    // What the triangles at an edge share while it is split.
    struct EdgeSplit {
        std::uint32_t middle = 0;       // point
        std::uint32_t first_point = 0;  // of the edge
        std::size_t first_made = 0;     // of Changes::vertices
        std::array<std::uint32_t, 2> halves{};
        std::vector<std::uint32_t> to_apexes{};  // edges from the middle
    };

    void set_ends(std::uint32_t edge, std::uint32_t point, std::uint32_t other);
    std::uint32_t add_edge(std::uint32_t point, std::uint32_t other);
    std::uint32_t add_chord(std::uint32_t edge, std::uint32_t vertex, std::uint32_t other);
    // Of an edge, joining these two; made where there is none.
    std::uint32_t chord_of(std::uint32_t edge,
                           std::uint32_t vertex,
                           std::uint32_t other,
                           Changes& changes);
    [[nodiscard]] bool is_longer(std::uint32_t edge, std::uint32_t other) const;
    void join_start();
    [[nodiscard]] std::size_t corner_at(std::uint32_t triangle, std::uint32_t edge) const;
    std::uint32_t vertex_in_middle(std::uint32_t triangle,
                                   std::size_t corner,
                                   const EdgeSplit& split,
                                   Changes& changes);
    std::uint32_t edge_to_apex(std::uint32_t apex, EdgeSplit& split);
    // The triangle becomes two, from the middle of the side at a corner to the apex.
    void cut(std::uint32_t triangle, std::size_t corner, EdgeSplit& split, Changes& changes);

    StartSurface start_;
    std::vector<Imath::V3f> points_;
    std::vector<StartVertex> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<Chord> chords_;
    std::vector<Edge> edges_;
    double turn_length_ = 0;  // what a change of the normal by one is as a length
};

}  // namespace relume::bake
