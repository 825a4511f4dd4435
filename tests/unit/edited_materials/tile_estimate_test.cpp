// What a tile shows of an edited material, beside the integral that the contract states
// (protocol/README.md §2), summed over a fine grid of directions.
#include "server/materials/tile_estimate.h"

#include "protocol/basis/cubemap.h"
#include "protocol/brdf/local_frame.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_materials.h"
#include "tests/support/tiny_transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace relume::materials {
namespace {

constexpr std::uint32_t kLightTexels = 8;
constexpr std::uint32_t kFine = 64;  // of the grid, along a face

// Smooth, with one texel that outshines the others.
light::LightCubemap light_with_a_lamp() {
    light::LightCubemap light(kLightTexels);
    for (std::size_t texel = 0; texel < light.plane_size(); ++texel) {
        const Imath::V3f direction = basis::direction_from_texel(
            kLightTexels, basis::texel_from_index(kLightTexels, texel));
        for (std::size_t c = 0; c < 3; ++c) {
            light.planes()[c][texel] =
                1 + 0.5F * direction[static_cast<int>(c)] + (texel == 150 ? 30.0F : 0.0F);
        }
    }
    return light;
}

class TileEstimateTest : public testing::Test {
  protected:
    TileEstimateTest() {
        const auto path = folder_.path() / "tiny.relume";
        test::write_tiny_transport(path);
        test::add_random_materials(path);
        points_.emplace(transport::Transport::open(path));
    }

    [[nodiscard]] ShownMaterial as_baked(std::size_t material) const {
        return {.material = material, .brdf = points_->materials()[material].brdf};
    }

    // Of all pixels of the tile, [256][3].
    [[nodiscard]] std::vector<double> change_by_definition(const ShownMaterial& shown,
                                                           std::uint32_t tile) const {
        const EditableMaterial& material = points_->materials()[shown.material];
        std::vector<std::uint64_t> bits;
        points_->visibility().read(tile, bits);
        const std::size_t words = points_->visibility().words_per_point();
        const std::uint32_t n = points_->visibility().face_resolution();
        std::vector<double> rgb(std::size_t{3} * 256, 0);
        const auto points = points_->points(tile);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (points[i].material != shown.material) {
                continue;
            }
            const brdf::Frame frame = brdf::local_frame(points[i].normal);
            const Imath::V3f wo = frame.local_from_world(points[i].wo);
            const brdf::DiffuseLobe lobe{.colour = points[i].diffuse, .coat = material.coat};
            for (std::size_t at = 0; at < std::size_t{6} * kFine * kFine; ++at) {
                const basis::Texel fine = basis::texel_from_index(kFine, at);
                const Imath::V3f direction = basis::direction_from_texel(kFine, fine);
                const Imath::V3f wi = frame.local_from_world(direction);
                const std::size_t seen =
                    basis::index_from_texel(n, basis::texel_from_direction(n, direction));
                if (wi.z <= 0 || direction.dot(points[i].geometric_normal) <= 0 ||
                    !transport::is_open(std::span(bits).subspan(i * words, words), seen)) {
                    continue;
                }
                const Imath::V3f more =
                    (shown.brdf.evaluate(wi, wo) - material.brdf.evaluate(wi, wo)) * wi.z +
                    (shown.diffuse - Imath::V3f(1)) * lobe.times_cosine(wi.z, wo.z);
                const double weight = double{points[i].share} *
                                      basis::solid_angle_sr(kFine, fine.row, fine.column);
                const std::size_t lit = basis::index_from_texel(
                    kLightTexels, basis::texel_from_direction(kLightTexels, direction));
                for (std::size_t c = 0; c < 3; ++c) {
                    rgb[3 * points[i].slot + c] += weight * double{more[static_cast<int>(c)]} *
                                                   double{light_.planes()[c][lit]};
                }
            }
        }
        return rgb;
    }

    // ‖found − expected‖ / ‖expected‖ over the tile.
    static double distance(const TileChange& found, const std::vector<double>& expected) {
        std::vector<double> difference = expected;
        for (std::size_t i = 0; i < found.slots.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                difference[std::size_t{3} * found.slots[i] + c] -= double{found.rgb[3 * i + c]};
            }
        }
        double error = 0;
        double norm = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            error += difference[i] * difference[i];
            norm += expected[i] * expected[i];
        }
        return std::sqrt(error / norm);
    }
    [[nodiscard]] static TileChange change(const TileColumns& columns,
                                           const ShownMaterial& shown) {
        TileChange change;
        change.slots.assign(columns.slots().begin(), columns.slots().end());
        change.rgb.resize(3 * change.slots.size());
        columns.change(shown.brdf.curves()[shown.taken_up].curve, shown.diffuse, change.rgb);
        return change;
    }

    test::ScratchDirectory folder_;
    std::optional<EditablePoints> points_;
    light::LightCubemap light_ = light_with_a_lamp();
    PresentLight present_{light_};
};

TileColumns columns_of(const TileEstimate& estimate,
                       const ShownMaterial& shown,
                       std::uint32_t tile,
                       std::uint32_t samples) {
    ColumnSum sum;
    estimate.add_directions(shown, tile, {.samples = samples}, sum);
    return {std::move(sum.slots), std::move(sum.values)};
}

// Curves of twice the values where the other half of them is zero.
curve::Curve halved(const curve::Curve& curve) {
    curve::Curve half = curve;
    for (auto& channel : half.rgb) {
        for (std::size_t k = 0; k < channel.size(); ++k) {
            channel[k] *= k < channel.size() / 8 ? 0.0F : 2.0F;
        }
    }
    return half;
}

TEST_F(TileEstimateTest, ColumnsShowWhatTheContractSays) {
    const TileEstimate estimate(*points_, present_);
    for (std::size_t material = 0; material < 2; ++material) {
        for (std::size_t curve = 0; curve < 2; ++curve) {
            ShownMaterial shown = as_baked(material);
            shown.taken_up = curve;
            shown.brdf = shown.brdf.with_curve(curve, halved(shown.brdf.curves()[curve].curve));
            shown.diffuse = {0.2F, 1, 3};
            const TileColumns columns = columns_of(estimate, shown, 1, 256);
            EXPECT_LT(distance(change(columns, shown), change_by_definition(shown, 1)), 0.015)
                << material << " " << curve;
        }
    }
}

// One curve is taken up while another has been edited before.
TEST_F(TileEstimateTest, ColumnsHeedTheOtherCurvesAsTheyAre) {
    const TileEstimate estimate(*points_, present_);
    ShownMaterial shown = as_baked(0);
    shown.brdf = shown.brdf.with_curve(0, halved(shown.brdf.curves()[0].curve));
    shown.taken_up = 1;
    shown.brdf = shown.brdf.with_curve(1, halved(shown.brdf.curves()[1].curve));
    const TileColumns columns = columns_of(estimate, shown, 0, 256);
    EXPECT_LT(distance(change(columns, shown), change_by_definition(shown, 0)), 0.015);
}

TEST_F(TileEstimateTest, PartsAreTogetherAllDirections) {
    const TileEstimate estimate(*points_, present_);
    const ShownMaterial shown = as_baked(1);
    ColumnSum at_once;
    estimate.add_directions(shown, 1, {.samples = 16}, at_once);
    ColumnSum by_parts;
    for (std::uint32_t part = 0; part < 5; ++part) {
        estimate.add_directions(shown, 1, {.samples = 16, .part = part, .parts = 5}, by_parts);
    }
    EXPECT_EQ(by_parts.slots, at_once.slots);
    for (std::size_t i = 0; i < at_once.values.samples.size(); ++i) {
        EXPECT_NEAR(by_parts.values.samples[i], at_once.values.samples[i],
                    1e-5 * (1e-3 + at_once.values.samples[i]));
    }
}

TEST_F(TileEstimateTest, AMaterialAsBakedChangesNothing) {
    const TileEstimate estimate(*points_, present_);
    const ShownMaterial shown = as_baked(0);
    const TileChange still = change(columns_of(estimate, shown, 0, 8), shown);
    ShownMaterial black = shown;
    black.brdf = shown.brdf.with_curve(0, curve::Curve{});
    const TileChange all = change(columns_of(estimate, shown, 0, 8), black);
    for (std::size_t i = 0; i < still.rgb.size(); ++i) {
        EXPECT_NEAR(still.rgb[i], 0, 1e-4 * std::abs(all.rgb[i]) + 1e-6);
    }
}

TEST_F(TileEstimateTest, MoreDirectionsAreNearerAndAGlanceIsNotFar) {
    const TileEstimate estimate(*points_, present_);
    ShownMaterial shown = as_baked(1);
    shown.diffuse = {2, 2, 2};
    shown.brdf = shown.brdf.with_curve(1, halved(shown.brdf.curves()[1].curve));
    shown.taken_up = 1;
    const std::vector<double> truth = change_by_definition(shown, 2);
    const double glance = distance(estimate.glance(shown, 2), truth);
    const double few = distance(change(columns_of(estimate, shown, 2, 4), shown), truth);
    const double many = distance(change(columns_of(estimate, shown, 2, 64), shown), truth);
    EXPECT_LT(many, few);
    EXPECT_LT(few, glance);
    EXPECT_LT(glance, 0.5);
}

TEST_F(TileEstimateTest, PointsThatSeeNothingShowNothing) {
    const auto path = folder_.path() / "closed.relume";
    test::write_tiny_transport(path);
    transport::VisibilityFieldBuilder closed(8, 6);
    transport::SeenPointsBuilder points(6);
    points.set_block(3, std::vector<transport::SeenPoint>(1, {.slot = 5, .share = 1}));
    closed.set_block(3, std::vector<std::uint64_t>(6, 0));
    test::add_materials(path, closed, points, test::tiny_editable_materials());
    const EditablePoints dark(transport::Transport::open(path));
    const TileEstimate estimate(dark, present_);
    ShownMaterial shown{.material = 0, .brdf = dark.materials()[0].brdf, .diffuse = {5, 5, 5}};
    const TileChange found = change(columns_of(estimate, shown, 3, 16), shown);
    EXPECT_EQ(found.slots, std::vector<std::uint8_t>{5});
    EXPECT_EQ(found.rgb, std::vector<float>(3, 0.0F));
    EXPECT_EQ(estimate.glance(shown, 3).rgb, std::vector<float>(3, 0.0F));
    EXPECT_TRUE(columns_of(estimate, shown, 0, 16).slots().empty());
}

}  // namespace
}  // namespace relume::materials
