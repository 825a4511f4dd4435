#include "precompute/scene/polygons/triangulation.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"

#include <GL/glu.h>
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <new>

namespace relume::scene {
namespace {

Imath::V3d position_of(const PolygonMesh& mesh, std::uint32_t corner) {
    return mesh.positions[mesh.corners[corner].position];
}

// Twice the area vector [Newell's method]; relative to the first corner, so that distance from
// the origin costs nothing.
Imath::V3d area_vector(const PolygonMesh& mesh, const Polygon& polygon) {
    const Imath::V3d origin = position_of(mesh, polygon.first);
    Imath::V3d sum(0, 0, 0);
    for (std::uint32_t i = 1; i + 1 < polygon.count; ++i)
        sum += (position_of(mesh, polygon.first + i) - origin)
                   .cross(position_of(mesh, polygon.first + i + 1) - origin);
    return sum;
}

// Whether a fan about the first corner fills it: no corner turns back.
bool is_convex_quad(const PolygonMesh& mesh, const Polygon& polygon, const Imath::V3d& area) {
    if (polygon.count != 4)
        return false;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Imath::V3d a = position_of(mesh, polygon.first + i);
        const Imath::V3d b = position_of(mesh, polygon.first + (i + 1) % 4);
        const Imath::V3d c = position_of(mesh, polygon.first + (i + 2) % 4);
        if (!((b - a).cross(c - b).dot(area) > 0))
            return false;
    }
    return true;
}

// The library calls back through C: nothing is thrown from there.
class Tessellator {
  public:
    explicit Tessellator(PolygonMesh& mesh) : mesh_(mesh), tessellator_(gluNewTess()) {
        if (!tessellator_)
            throw std::bad_alloc();
        using Callback = void (*)();
        const auto set = [&](GLenum which, Callback callback) {
            gluTessCallback(tessellator_.get(), which, callback);
        };
        set(GLU_TESS_VERTEX_DATA, reinterpret_cast<Callback>(&Tessellator::vertex));
        set(GLU_TESS_COMBINE_DATA, reinterpret_cast<Callback>(&Tessellator::combine));
        set(GLU_TESS_ERROR_DATA, reinterpret_cast<Callback>(&Tessellator::fail));
        // Its presence alone makes the library give triangles only, no fans.
        set(GLU_TESS_EDGE_FLAG_DATA, reinterpret_cast<Callback>(&Tessellator::edge_flag));
        gluTessProperty(tessellator_.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
    }

    // Corners of triangles, three by three; empty where the polygon has no area or the library
    // gives up.
    const std::vector<std::uint32_t>& run(const Polygon& polygon, const Imath::V3d& area) {
        found_.clear();
        failed_ = false;
        const Imath::V3d origin = position_of(mesh_, polygon.first);
        origin_ = origin;
        places_.resize(polygon.count);
        gluTessNormal(tessellator_.get(), area.x, area.y, area.z);
        gluTessBeginPolygon(tessellator_.get(), this);
        gluTessBeginContour(tessellator_.get());
        for (std::uint32_t i = 0; i < polygon.count; ++i) {
            const Imath::V3d p = position_of(mesh_, polygon.first + i) - origin;
            places_[i] = {p.x, p.y, p.z};
            gluTessVertex(tessellator_.get(), places_[i].data(),
                          pointer_from(polygon.first + i));
        }
        gluTessEndContour(tessellator_.get());
        gluTessEndPolygon(tessellator_.get());
        if (failed_ || found_.size() % 3 != 0)
            found_.clear();
        return found_;
    }

  private:
    // One above the corner, so that none is a null pointer.
    static void* pointer_from(std::uint32_t corner) {
        return reinterpret_cast<void*>(static_cast<std::uintptr_t>(corner) + 1);
    }
    static std::uint32_t corner_from(const void* pointer) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer) - 1);
    }

    static void vertex(void* corner, void* self) {
        static_cast<Tessellator*>(self)->found_.push_back(corner_from(corner));
    }
    static void edge_flag(GLboolean /*flag*/, void* /*self*/) {}
    static void fail(GLenum /*error*/, void* self) {
        static_cast<Tessellator*>(self)->failed_ = true;
    }

    template <typename Value>
    static std::uint32_t blend(std::vector<Value>& values,
                               void* const corners[4],
                               const float weights[4],
                               const std::vector<PolygonCorner>& all,
                               std::uint32_t PolygonCorner::*index) {
        Value sum(0);
        for (int i = 0; i < 4; ++i) {
            if (corners[i] == nullptr || weights[i] == 0)
                continue;
            const std::uint32_t from = all[corner_from(corners[i])].*index;
            if (from == kNone)
                return kNone;
            sum += values[from] * weights[i];
        }
        values.push_back(sum);
        return static_cast<std::uint32_t>(values.size() - 1);
    }

    // Where edges cross: a corner that mixes those around it.
    static void combine(GLdouble place[3],
                        void* corners[4],
                        GLfloat weights[4],
                        void** out,
                        void* self_pointer) {
        auto& self = *static_cast<Tessellator*>(self_pointer);
        PolygonMesh& mesh = self.mesh_;
        PolygonCorner corner;
        if (!mesh.colours.empty())
            (void)blend(mesh.colours, corners, weights, mesh.corners, &PolygonCorner::position);
        corner.uv = blend(mesh.uvs, corners, weights, mesh.corners, &PolygonCorner::uv);
        corner.normal =
            blend(mesh.normals, corners, weights, mesh.corners, &PolygonCorner::normal);
        corner.position = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(self.origin_ + Imath::V3d(place[0], place[1], place[2]));
        mesh.corners.push_back(corner);
        *out = pointer_from(static_cast<std::uint32_t>(mesh.corners.size() - 1));
    }

    struct Free {
        void operator()(GLUtesselator* tessellator) const { gluDeleteTess(tessellator); }
    };

    PolygonMesh& mesh_;
    std::unique_ptr<GLUtesselator, Free> tessellator_;
    std::vector<std::array<double, 3>> places_;
    std::vector<std::uint32_t> found_;
    Imath::V3d origin_{0, 0, 0};
    bool failed_ = false;
};

}  // namespace

std::vector<CornerTriangle> triangulated(PolygonMesh& mesh, std::uint64_t max_triangles) {
    std::vector<CornerTriangle> triangles;
    Tessellator tessellator(mesh);
    for (std::uint32_t i = 0; i < mesh.polygons.size(); ++i) {
        const Polygon polygon = mesh.polygons[i];
        const std::uint32_t first = polygon.first;
        if (polygon.count > kMaxPolygonCorners)
            throw SceneError(
                SceneFault::too_large,
                fmt::format("scene '{}': face {} has {} corners; expected at most {}",
                            shown_text(mesh.name), i, polygon.count, kMaxPolygonCorners));
        if (triangles.size() > max_triangles)
            throw SceneError(SceneFault::too_large,
                             fmt::format("scene '{}' has more than {} triangles",
                                         shown_text(mesh.name), max_triangles));
        if (polygon.count == 3) {
            triangles.push_back({{first, first + 1, first + 2}, i});
            continue;
        }
        const Imath::V3d area = area_vector(mesh, polygon);
        // Numbers that are none are left to the check of all positions; the library could not.
        if (!std::isfinite(area.length()) || is_convex_quad(mesh, polygon, area)) {
            for (std::uint32_t k = 1; k + 1 < polygon.count; ++k)
                triangles.push_back({{first, first + k, first + k + 1}, i});
            continue;
        }
        const std::vector<std::uint32_t>& found = tessellator.run(polygon, area);
        for (std::size_t k = 0; k + 2 < found.size(); k += 3)
            triangles.push_back({{found[k], found[k + 1], found[k + 2]}, i});
    }
    return triangles;
}

}  // namespace relume::scene
