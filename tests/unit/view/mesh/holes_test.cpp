// Holes in materials show what lies behind them.
#include "server/view/mesh/holes.h"

#include "server/view/mesh/visible_surface.h"
#include "tests/support/surface_shapes.h"
#include "tests/unit/view/mesh/rays.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace relume::view {
namespace {

constexpr std::uint32_t kSide = 48;
constexpr std::uint32_t kTexels = 8;
constexpr float kCutoff = 0.5F;

// A room, and in it a box of a material with holes: spots on all its sides.
class HolesTest : public testing::Test {
  protected:
    HolesTest() {
        transport::Surface surface;
        surface.mesh = test::together(test::room(3), test::box(2, {0.1F, -0.2F, 0}, 0.4F));
        std::mt19937 random(4);
        std::uniform_real_distribution<float> alpha(0, 1);
        transport::SurfaceTexture texture{.width = kTexels, .height = kTexels, .rgb = {}};
        for (std::uint32_t i = 0; i < kTexels * kTexels; ++i) {
            texture.rgb.insert(texture.rgb.end(), 3, half(alpha(random)));
        }
        surface.textures.push_back(std::move(texture));
        first_of_box_ = static_cast<std::uint32_t>(surface.mesh.triangles.size()) - 6 * 2 * 4;
        for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
            surface.mesh.triangles[i].material = i < first_of_box_ ? 0 : 1;
        }
        // As the faces lie in space: a texture of its own for nobody.
        surface.mesh.uvs.clear();
        for (transport::SurfaceTriangle& triangle : surface.mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Imath::V3f& p = surface.mesh.positions[triangle.vertices[k]];
                triangle.uvs[k] = static_cast<std::uint32_t>(surface.mesh.uvs.size());
                surface.mesh.uvs.emplace_back(p.x + 0.4F * p.z, p.y - 0.3F * p.z);
            }
        }
        surface_ = std::make_shared<const transport::Surface>(std::move(surface));
        materials_ = {{.name = "room", .lobes = {}},
                      {.name = "spots",
                       .lobes = {},
                       .cutout = transport::CutoutRecord{.texture = 0, .cutoff = kCutoff}}};
        holes_.emplace(surface_, materials_);
    }

    // How far above the cutoff; a hole where it is negative.
    [[nodiscard]] float above_cutoff(const Hit& hit) const {
        const auto& uvs = surface_->mesh.triangles[hit.triangle].uvs;
        const Imath::V2f uv =
            surface_->mesh.uvs[uvs[0]] * static_cast<float>(1 - hit.weight_1 - hit.weight_2) +
            surface_->mesh.uvs[uvs[1]] * static_cast<float>(hit.weight_1) +
            surface_->mesh.uvs[uvs[2]] * static_cast<float>(hit.weight_2);
        return transport::red_at(surface_->textures[0], uv) - kCutoff;
    }
    [[nodiscard]] Hit seen(const Imath::V3d& eye, const Imath::V3d& ray, float& margin) const {
        return nearest_front(surface_->mesh, eye, ray, [&](const Hit& hit) {
            if (hit.triangle < first_of_box_) {
                return true;
            }
            const float above = above_cutoff(hit);
            margin = std::min(margin, std::abs(above));
            return above >= 0;
        });
    }

    std::shared_ptr<const transport::Surface> surface_;
    std::vector<transport::MaterialRecord> materials_;
    std::optional<Holes> holes_;
    std::uint32_t first_of_box_ = 0;
};

TEST_F(HolesTest, ShowWhatRaysMeetBehindThem) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-0.9, 0.9);
    std::size_t solid = 0;
    std::size_t through = 0;
    for (const double fov : {30.0, 80.0}) {
        for (int i = 0; i < 8; ++i) {
            const Imath::V3d eye(place(random), 0.5 + 0.4 * place(random), 0.9);
            const Pinhole pinhole = pinhole_at(eye, {0.1, -0.2, 0}, fov);
            VisibleSurface surface;
            surface.look(surface_->mesh, pinhole, kSide, kSide, &*holes_);
            for (std::uint32_t y = 0; y < kSide; ++y) {
                for (std::uint32_t x = 0; x < kSide; ++x) {
                    const Imath::V3d ray = ray_through(pinhole, x + 0.5, y + 0.5, kSide);
                    float margin = 1;
                    const Hit hit = seen(eye, ray, margin);
                    if (hit.margin < 1e-6 || margin < 1e-4F) {
                        continue;
                    }
                    ASSERT_EQ(surface.point(x, y).triangle, hit.triangle) << x << ", " << y;
                    const bool passes_box =
                        nearest_front(surface_->mesh, eye, ray).triangle >= first_of_box_;
                    solid += hit.triangle >= first_of_box_ ? 1U : 0U;
                    through += passes_box && hit.triangle < first_of_box_ ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_GT(solid, 1000U);
    EXPECT_GT(through, 1000U);
}

// At rest a pixel shows as much of a hole as there is of it in the pixel, also where its middle
// and those of its neighbours are solid.
TEST_F(HolesTest, AreSmoothAtRest) {
    const Imath::V3d eye(0.3, 0.4, 0.95);
    const Pinhole pinhole = pinhole_at(eye, {0.1, -0.2, 0}, 50);
    VisibleSurface surface;
    surface.look(surface_->mesh, pinhole, kSide, kSide, &*holes_);
    surface.look_at_edges(surface_->mesh);
    std::size_t mixed = 0;
    std::size_t missed = 0;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            int of_box = 0;
            for (std::size_t i = 0; i < VisibleSurface::kSamplesOfEdge; ++i) {
                const SamplePosition at = VisibleSurface::position_of_sample(i);
                float margin = 1;
                const Hit hit =
                    seen(eye, ray_through(pinhole, x + at.x, y + at.y, kSide), margin);
                of_box += hit.triangle != kNoTriangle && hit.triangle >= first_of_box_ ? 1 : 0;
            }
            // An eighth and more of either.
            if (of_box >= 2 && of_box <= 14) {
                ++mixed;
                missed += surface.points(x, y).size() == 1 ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(mixed, 200U);
    EXPECT_LT(static_cast<double>(missed), 0.02 * static_cast<double>(mixed));
}

TEST_F(HolesTest, AreTheSameOnAnyNumberOfThreads) {
    const Pinhole pinhole = pinhole_at({0.3, 0.4, 0.95}, {0.1, -0.2, 0}, 60);
    VisibleSurface alone;
    VisibleSurface shared;
    tbb::task_arena(1).execute([&] {
        alone.look(surface_->mesh, pinhole, 130, 70, &*holes_);
        alone.look_at_edges(surface_->mesh);
    });
    shared.look(surface_->mesh, pinhole, 130, 70, &*holes_);
    shared.look_at_edges(surface_->mesh);
    ASSERT_EQ(alone.edge_count(), shared.edge_count());
    for (std::uint32_t y = 0; y < 70; ++y) {
        for (std::uint32_t x = 0; x < 130; ++x) {
            const auto a = alone.points(x, y);
            const auto b = shared.points(x, y);
            ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
        }
    }
}

// A look at a mesh without holes after one with holes has none.
TEST_F(HolesTest, AreForgottenWithTheNextLook) {
    const Pinhole pinhole = pinhole_at({0.3, 0.4, 0.95}, {0.1, -0.2, 0}, 60);
    VisibleSurface surface;
    surface.look(surface_->mesh, pinhole, kSide, kSide, &*holes_);
    surface.look(surface_->mesh, pinhole, kSide, kSide);
    VisibleSurface whole;
    whole.look(surface_->mesh, pinhole, kSide, kSide);
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        ASSERT_EQ(surface.point(i % kSide, i / kSide), whole.point(i % kSide, i / kSide));
    }
}

}  // namespace
}  // namespace relume::view
