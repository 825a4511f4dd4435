#include "server/view/mesh/mesh_view.h"

#include "protocol/brdf/local_frame.h"
#include "server/view/mesh/pinhole_from_look.h"
#include "tests/support/tiny_mesh.h"
#include "tests/unit/view/mesh/rays.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <vector>

namespace relume::view {
namespace {

using transport::kBlockSize;
using transport::kColours;

constexpr std::uint32_t kSide = 48;

class MeshViewTest : public testing::Test {
  protected:
    MeshViewTest() {
        surface_ = std::make_shared<const DrawnSurface>(
            std::shared_ptr<const transport::Surface>(std::shared_ptr<void>(), &tiny_.surface),
            tiny_.materials, clusters_);
        std::mt19937 random(7);
        std::uniform_real_distribution<float> value(0.1F, 1);
        const std::size_t floats = kColours * kBlockSize * clusters_.block_count();
        sums_.resize(floats);
        tint_.resize(floats);
        for (std::size_t first = 0; first < floats; first += kBlockSize) {
            std::array<float, kBlockSize> plane;
            std::generate(plane.begin(), plane.end(), [&] { return value(random); });
            transport::block_coefficients_from_receivers(transport::BlockBasis::haar_line,
                                                         plane);
            std::copy(plane.begin(), plane.end(), &sums_[first]);
        }
        std::generate(tint_.begin(), tint_.end(), [&] { return value(random); });
    }

    [[nodiscard]] Look look_from(const Imath::V3d& eye,
                                 const Imath::V3d& look_at,
                                 double fov) const {
        return {.eye = frame_.origin + eye * frame_.unit,
                .look_at = frame_.origin + look_at * frame_.unit,
                .up = {0, 1, 0},
                .fov_degrees = fov,
                .width = kSide,
                .height = kSide};
    }
    [[nodiscard]] MeshView view_of(const Look& look) const {
        return {surface_, VertexRadiance(clusters_, transport::BlockBasis::haar_line, tint_),
                frame_, look};
    }
    std::vector<float> image_of(MeshView& view) const {
        std::vector<float> rgb(std::size_t{3} * view.image().width * view.image().height);
        write_image(view, sums_, rgb);
        return rgb;
    }

    // Of a term of a vertex, by the definition.
    [[nodiscard]] Imath::V3f radiance(std::uint32_t vertex, std::uint32_t term) const {
        const transport::VertexPlace place = clusters_.place_of_vertex(vertex);
        Imath::V3f rgb;
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t first = ((place.block + term) * kColours + c) * kBlockSize;
            std::array<float, kBlockSize> plane;
            std::copy_n(&sums_[first], kBlockSize, plane.begin());
            transport::block_receivers_from_coefficients(transport::BlockBasis::haar_line,
                                                         plane);
            rgb[static_cast<int>(c)] = plane[place.slot] * tint_[first + place.slot];
        }
        return rgb;
    }
    // Which flat thing a ray meets: a face of the room or of the box; −1 for none.
    [[nodiscard]] int surface_at(const Pinhole& pinhole, double x, double y) const {
        const transport::SurfaceMesh& mesh = tiny_.surface.mesh;
        const Hit hit = nearest_front(mesh, pinhole.eye, ray_through(pinhole, x, y, kSide));
        if (hit.triangle == kNoTriangle) {
            return -1;
        }
        const Imath::V3f& normal = mesh.normals[mesh.triangles[hit.triangle].vertices[0]];
        const bool is_of_box = hit.triangle >= mesh.triangles.size() - 6 * 2 * 9;
        return static_cast<int>(std::lround(normal.x + 3 * normal.y + 9 * normal.z)) +
               (is_of_box ? 100 : 0) + 1000;
    }
    // Towards the eye, along a ray; black where it meets nothing. Textures are left out.
    [[nodiscard]] Imath::V3f seen(const Pinhole& pinhole, double x, double y) const {
        const transport::SurfaceMesh& mesh = tiny_.surface.mesh;
        const Imath::V3d ray = ray_through(pinhole, x, y, kSide);
        const Hit hit = nearest_front(mesh, pinhole.eye, ray);
        if (hit.triangle == kNoTriangle) {
            return Imath::V3f(0);
        }
        const auto& triangle = mesh.triangles[hit.triangle];
        const std::array<float, 3> shares{static_cast<float>(1 - hit.weight_1 - hit.weight_2),
                                          static_cast<float>(hit.weight_1),
                                          static_cast<float>(hit.weight_2)};
        Imath::V3f normal(0);
        for (std::size_t i = 0; i < 3; ++i) {
            normal += mesh.normals[triangle.vertices[i]] * shares[i];
        }
        const brdf::FactoredBrdf& brdf = tiny_.surface.brdfs[triangle.material];
        std::vector<float> h(std::size_t{brdf.terms} * brdf.lobes);
        brdf.h.evaluate(
            brdf::local_frame(normal.normalized()).local_from_world(Imath::V3f(-ray)), h);
        Imath::V3f sum(0);
        for (std::uint32_t k = 0; k < brdf.terms; ++k) {
            Imath::V3f weight(0);
            for (std::uint32_t l = 0; l < brdf.lobes; ++l) {
                weight +=
                    tiny_.materials[triangle.material].lobes[l].colour * h[k * brdf.lobes + l];
            }
            for (std::size_t i = 0; i < 3; ++i) {
                sum += weight * radiance(triangle.vertices[i], k) * shares[i];
            }
        }
        return sum;
    }

    test::TinyMesh tiny_ = [] {
        test::TinyMesh tiny = test::tiny_mesh();
        for (transport::MaterialRecord& material : tiny.materials) {
            for (transport::LobeRecord& lobe : material.lobes) {
                lobe.texture.reset();
            }
        }
        return tiny;
    }();
    const transport::VertexClusters clusters_{tiny_.clusters};
    const transport::FrameRecord frame_{.origin = {-3, 1e5, 7}, .unit = 40};
    std::shared_ptr<const DrawnSurface> surface_;
    std::vector<float> sums_;
    std::vector<float> tint_;
};

TEST_F(MeshViewTest, PixelsAreTheFactoredBrdfOfWhatRaysMeet) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.9, 0.9);
    for (int i = 0; i < 20; ++i) {
        const Imath::V3d eye(place(random), 0.2 + 0.7 * std::abs(place(random)), place(random));
        const Look look = look_from(eye, {0.2, -0.3, 0.1}, i % 2 == 0 ? 40 : 110);
        MeshView view = view_of(look);
        const std::vector<float> rgb = image_of(view);
        const Pinhole pinhole = pinhole_from_look(look, frame_);
        std::size_t wrong = 0;
        for (std::uint32_t pixel = 0; pixel < kSide * kSide; ++pixel) {
            const Imath::V3f expected = seen(pinhole, pixel % kSide + 0.5, pixel / kSide + 0.5);
            const Imath::V3f found(rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]);
            wrong += (found - expected).length() > 2e-4F * expected.length() ? 1U : 0U;
        }
        // Where a ray passes an edge within rounding, it may meet either side.
        EXPECT_LE(wrong, 1U) << "view " << i;
    }
}

TEST_F(MeshViewTest, AtRestPixelsOfEdgesAreTheMeanOfSixteenPlaces) {
    const Look look = look_from({0.9, 0.8, 0.7}, {0.2, -0.3, 0.1}, 50);
    MeshView view = view_of(look);
    EXPECT_TRUE(view.look_closer());
    EXPECT_FALSE(view.look_closer());
    const std::vector<float> rgb = image_of(view);
    const Pinhole pinhole = pinhole_from_look(look, frame_);
    std::size_t on_edges = 0;
    for (std::uint32_t pixel = 0; pixel < kSide * kSide; ++pixel) {
        Imath::V3f mean(0);
        std::set<int> surfaces;
        for (std::size_t i = 0; i < 16; ++i) {
            const SamplePosition at = VisibleSurface::position_of_sample(i);
            const double x = pixel % kSide + at.x;
            const double y = pixel / kSide + at.y;
            mean += seen(pinhole, x, y) / 16;
            surfaces.insert(surface_at(pinhole, x, y));
        }
        const Imath::V3f found(rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]);
        if (surfaces.size() > 1) {
            ++on_edges;
            EXPECT_LT((found - mean).length(), 1e-3F * mean.length()) << pixel;
        }
    }
    EXPECT_GT(on_edges, 30U);
}

// Bit for bit: whether terms are kept, on how many threads, and wherever it has been looked
// from meanwhile.
TEST_F(MeshViewTest, AnImageDependsOnLookAndSumsAlone) {
    const Look look = look_from({0.9, 0.8, 0.7}, {0.2, -0.3, 0.1}, 50);
    MeshView view = view_of(look);
    const std::vector<float> first = image_of(view);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(image_of(view), first) << i;
    }
    tbb::task_arena(4).execute([&] { EXPECT_EQ(image_of(view), first); });
    EXPECT_TRUE(view.look_closer());
    const std::vector<float> closer = image_of(view);
    EXPECT_NE(closer, first);
    EXPECT_EQ(image_of(view), closer);
    Look other = look;
    other.width = 33;
    other.fov_degrees = 90;
    EXPECT_TRUE(view.look(other));
    EXPECT_FALSE(view.look(other));
    EXPECT_NE(image_of(view), first);
    EXPECT_TRUE(view.look(look));
    EXPECT_EQ(image_of(view), first);
    EXPECT_TRUE(view.look_closer());
    EXPECT_EQ(image_of(view), closer);
}

// A block counts as far as places show its vertices; one that shows nowhere counts for nothing.
TEST_F(MeshViewTest, BlocksCountAsFarAsTheyShow) {
    // Along −X, into the middle of a face.
    MeshView view = view_of(look_from({0, 0.7, 0}, {-1, 0.7, 0}, 10));
    const std::vector<float> weights = view.block_weights();
    ASSERT_EQ(weights.size(), clusters_.block_count());
    double places = 0;
    for (std::size_t i = 0; i < clusters_.clusters().size(); ++i) {
        const transport::Cluster& cluster = clusters_.clusters()[i];
        const bool is_seen =
            tiny_.surface.mesh.normals[clusters_.first_vertex(i)] == Imath::V3f(1, 0, 0) &&
            i < 6;
        for (std::uint32_t k = 0; k < cluster.terms; ++k) {
            EXPECT_EQ(weights[clusters_.first_block(i) + k] > 0, is_seen) << i;
        }
        places += double{weights[clusters_.first_block(i)]} * cluster.vertices;
    }
    EXPECT_NEAR(places, 3 * kSide * kSide, 0.01);
    // Of what lies behind everything nothing is seen.
    MeshView outside = view_of(look_from({50, 0, 0}, {60, 0, 0}, 40));
    for (const float weight : outside.block_weights()) {
        EXPECT_EQ(weight, 1);
    }
}

// What a client needs that has the mesh and draws it by itself.
TEST_F(MeshViewTest, HandsOutTheRadianceOfEveryTermOfEveryVertex) {
    MeshView view = view_of(look_from({0.9, 0.8, 0.7}, {0.2, -0.3, 0.1}, 50));
    static_cast<void>(image_of(view));
    const std::span<const float> values = view.radiance().values();
    ASSERT_EQ(values.size(), VertexRadiance::kFloatsPerTerm * surface_->term_count());
    for (std::uint32_t vertex = 0; vertex < clusters_.vertex_count(); vertex += 5) {
        for (std::uint32_t k = 0; k < clusters_.place_of_vertex(vertex).terms; ++k) {
            const std::size_t at =
                VertexRadiance::kFloatsPerTerm * (surface_->first_term(vertex) + k);
            EXPECT_EQ(Imath::V3f(values[at], values[at + 1], values[at + 2]),
                      radiance(vertex, k));
        }
    }
}

TEST_F(MeshViewTest, BlocksMayHoldTheValuesThemselves) {
    VertexRadiance radiance(clusters_, transport::BlockBasis::identity, tint_);
    radiance.take(sums_);
    for (std::uint32_t vertex = 0; vertex < clusters_.vertex_count(); ++vertex) {
        const transport::VertexPlace place = clusters_.place_of_vertex(vertex);
        const std::size_t first = place.block * kColours * kBlockSize + place.slot;
        const std::size_t at = VertexRadiance::kFloatsPerTerm * surface_->first_term(vertex);
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t value = first + c * kBlockSize;
            ASSERT_EQ(radiance.values()[at + c], sums_[value] * tint_[value]);
        }
    }
}

TEST_F(MeshViewTest, NewSumsAreTakenWhenTheyAreSaidToBeNew) {
    MeshView view = view_of(look_from({0.9, 0.8, 0.7}, {0.2, -0.3, 0.1}, 50));
    const std::vector<float> first = image_of(view);
    for (float& sum : sums_) {
        sum *= 2;
    }
    view.sums_have_changed();
    const std::vector<float> second = image_of(view);
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(second[i], 2 * first[i]);
    }
}

// What lies below the horizon of the interpolated normal is seen along the horizon.
TEST_F(MeshViewTest, NormalsThatTurnAwayLeaveNoDarkRims) {
    for (Imath::V3f& normal : tiny_.surface.mesh.normals) {
        normal = -normal;
    }
    MeshView view = view_of(look_from({0.9, 0.8, 0.7}, {0.2, -0.3, 0.1}, 50));
    for (const float value : image_of(view)) {
        EXPECT_GT(value, 0);
    }
}

TEST_F(MeshViewTest, IsFiniteFromWherever) {
    const transport::SurfaceMesh& mesh = tiny_.surface.mesh;
    for (const Imath::V3d& eye :
         {Imath::V3d(mesh.positions[3]), Imath::V3d(1, 0.1, 0.2), Imath::V3d(0.2, -0.3, 0.1),
          Imath::V3d(3, 2, 1), Imath::V3d(1e7, 0, 0), Imath::V3d(0.1, 0.2, 0.3)}) {
        for (const Imath::V3d& target : {Imath::V3d(0.1, 0.2, 0.3), Imath::V3d(0.1, 90, 0.3)}) {
            for (const double fov : {0.01, 90.0, 179.0}) {
                MeshView view = view_of(look_from(eye, target, fov));
                static_cast<void>(view.look_closer());
                for (const float value : image_of(view)) {
                    ASSERT_TRUE(std::isfinite(value)) << eye << ", " << fov << " degrees";
                }
                std::vector<float> coverage(kSide * kSide);
                view.write_coverage(coverage);
                for (const float value : coverage) {
                    ASSERT_TRUE(value >= 0 && value <= 1) << eye << ", " << fov << " degrees";
                }
            }
        }
    }
}

// A transport's textures are on its surface: a texture of one colour is that colour.
TEST_F(MeshViewTest, TexturesMultiplyTheColoursOfLobes) {
    for (transport::MaterialRecord& material : tiny_.materials) {
        for (transport::LobeRecord& lobe : material.lobes) {
            lobe.texture = 0;
        }
    }
    tiny_.surface.textures[0].rgb.assign(tiny_.surface.textures[0].rgb.size(), half(0.25F));
    const Look look = look_from({0.9, 0.8, 0.7}, {0.2, -0.3, 0.1}, 50);
    MeshView plain = view_of(look);
    surface_ = std::make_shared<const DrawnSurface>(
        std::shared_ptr<const transport::Surface>(std::shared_ptr<void>(), &tiny_.surface),
        tiny_.materials, clusters_);
    MeshView textured = view_of(look);
    const std::vector<float> expected = image_of(plain);
    const std::vector<float> found = image_of(textured);
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], 0.25F * expected[i], 1e-5F * expected[i]);
    }
}

// The camera of protocol/README.md §3.1.
TEST(PinholeFromLook, IsThatOfTheContract) {
    const transport::FrameRecord frame{.origin = {1, 2, 3}, .unit = 2};
    const Look look{.eye = {3, 2, 7},
                    .look_at = {3, 2, 5},
                    .up = {0.5, 2, 0},
                    .fov_degrees = 90,
                    .width = 30,
                    .height = 10};
    const Pinhole pinhole = pinhole_from_look(look, frame);
    EXPECT_LT((pinhole.eye - Imath::V3d(1, 0, 2)).length(), 1e-12);
    EXPECT_LT((pinhole.forward - Imath::V3d(0, 0, -1)).length(), 1e-12);
    EXPECT_NEAR(pinhole.tan_half_height, 1, 1e-12);
    EXPECT_NEAR(pinhole.tan_half_width, 3, 1e-12);
    EXPECT_NEAR(pinhole.up.dot(Imath::V3d(0.5, 2, 0).normalized()), 1, 1e-12);
    EXPECT_LT((pinhole.right.cross(pinhole.up) + pinhole.forward).length(), 1e-12);
    // Where look and up say nothing.
    Look nowhere = look;
    nowhere.look_at = look.eye;
    EXPECT_EQ(pinhole_from_look(nowhere, frame).forward, Imath::V3d(0, 0, -1));
    Look upwards = look;
    upwards.look_at = look.eye + Imath::V3d(0, 4, 0);
    upwards.up = {0, 1, 0};
    const Pinhole up = pinhole_from_look(upwards, frame);
    EXPECT_NEAR(up.up.z, 1, 1e-12);
    // Farther away than squares of doubles reach.
    Look far = look;
    far.look_at = {3, 2, -1e200};
    EXPECT_EQ(pinhole_from_look(far, frame).forward, Imath::V3d(0, 0, -1));
}

}  // namespace
}  // namespace relume::view
