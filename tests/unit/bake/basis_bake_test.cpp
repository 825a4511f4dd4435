// From scene to relit image in either basis of light.
#include "precompute/bake/bake.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/bake/relit_pictures.h"

#include <gtest/gtest.h>

namespace relume::bake {
namespace {

using Kind = basis::CubemapBasis::Kind;

constexpr std::uint32_t kN = 16;

BakeParameters parameters_of(Kind kind, std::uint32_t order = 0) {
    return {.width = 32,
            .height = 32,
            .face_resolution = kN,
            .basis = kind,
            .order = order,
            .bounces = 0,
            .pixel_samples = 1};
}

class BasisBake : public testing::Test {
  protected:
    std::shared_ptr<const transport::Transport> baked(const char* scene,
                                                      const BakeParameters& parameters) {
        const auto path = scratch_.path() / std::to_string(count_++);
        bake(scene::build_builtin_scene(scene), parameters, path);
        return transport::Transport::open(path);
    }

    test::ScratchDirectory scratch_;
    int count_ = 0;
};

TEST_F(BasisBake, UnoccludedWhiteLambertShowsItsAlbedoUnderConstantLight) {
    const CubemapLight white = light_from(kN, [](const Imath::V3f&) { return 1.0F; });
    for (const std::uint32_t order : {1U, 5U, 20U}) {
        const auto transport = baked("plane", parameters_of(Kind::spherical_harmonics, order));
        EXPECT_EQ(transport->column_count(), std::size_t{order} * order);
        EXPECT_EQ(transport->channel_count(), 1U);
        for (const auto& plane : relight(*transport, white).rgb) {
            for (const double value : plane) {
                ASSERT_NEAR(value, 1, 5e-3);
            }
        }
    }
}

// Indirect light has its share of the furnace too, without bias: what a basis does to noise is
// another matter.
TEST_F(BasisBake, BothBasesGiveTheSameInterreflectionUnderConstantLight) {
    const CubemapLight white = light_from(kN, [](const Imath::V3f&) { return 1.0F; });
    BakeParameters haar = parameters_of(Kind::haar);
    haar.bounces = 3;
    haar.samples = 16;
    BakeParameters harmonics = haar;
    harmonics.basis = Kind::spherical_harmonics;
    harmonics.order = 4;
    const DenseImage reference = relight(*baked("box", haar), white);
    EXPECT_LT(relative_l2(relight(*baked("box", harmonics), white), reference), 5e-3);
}

// Spherical harmonics and wavelets are two ways to write one transport.
TEST_F(BasisBake, ConvergesToTheWaveletImageUnderLowFrequencyLight) {
    // A lobe as wide as a clouded sun.
    const CubemapLight light = light_from(kN, [](const Imath::V3f& d) {
        return std::exp(5 * (d.dot(Imath::V3f(0.48F, 0.8F, 0.36F)) - 1));
    });
    const DenseImage reference = relight(*baked("table", parameters_of(Kind::haar)), light);
    double last = 1;
    for (const std::uint32_t order : {2U, 5U, 12U}) {
        const double error = relative_l2(
            relight(*baked("table", parameters_of(Kind::spherical_harmonics, order)), light),
            reference);
        EXPECT_LT(error, last) << order;
        last = error;
    }
    EXPECT_LT(last, 0.01);
}

TEST_F(BasisBake, ADirectoryKnowsItsBasis) {
    const auto haar = baked("plane", parameters_of(Kind::haar));
    const auto harmonics = baked("plane", parameters_of(Kind::spherical_harmonics, 3));
    EXPECT_EQ(haar->manifest().signal_basis, basis::CubemapBasis::haar(kN));
    EXPECT_EQ(harmonics->manifest().signal_basis,
              basis::CubemapBasis::spherical_harmonics(3, kN));
    EXPECT_NE(haar->manifest().fingerprint, harmonics->manifest().fingerprint);
}

}  // namespace
}  // namespace relume::bake
