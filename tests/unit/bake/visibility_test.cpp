#include "precompute/bake/rows/visibility.h"

#include "precompute/scene/builtin.h"
#include "protocol/transport/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace relume::bake {
namespace {

JitterShift random_shift(std::uint64_t seed) {
    JitterShift shift;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        const std::uint64_t bits = transport::mix_bits(seed * kPacketSize + lane);
        shift.column[lane] = transport::unit_float(bits);
        shift.row[lane] = transport::unit_float(bits << 32U);
    }
    return shift;
}

class VisibilityOfThinThings : public testing::Test {
  protected:
    // On the ground, in the middle of the scene's shadows.
    [[nodiscard]] Imath::V3f origin() const {
        const Imath::Box3f bounds = scene_.bounds();
        const Imath::V3f centre = bounds.center();
        return {centre.x + 0.05F, bounds.min.y + 0.02F * bounds.size().y, centre.z};
    }
    [[nodiscard]] std::array<Imath::V3f, kPacketSize> origins() const {
        std::array<Imath::V3f, kPacketSize> all;
        all.fill(origin());
        return all;
    }
    std::vector<float> open(std::uint32_t edge_samples,
                            const JitterShift& shift,
                            float share = 1) {
        std::vector<float> result(texels_.size());
        Visibility(caster_, texels_, edge_samples)
            .compute(origins(), share, shift, wanted_, result, scratch_);
        return result;
    }

    scene::Scene scene_ = scene::build_builtin_scene("thin");
    RayCaster caster_{scene_};
    LightTexels texels_{16, 7};
    std::vector<float> wanted_ = std::vector<float>(texels_.size(), 1.0F);
    Visibility::Scratch scratch_;
};

TEST_F(VisibilityOfThinThings, EqualsBruteForceRayByRay) {
    const JitterShift shift = random_shift(0);
    const auto found = open(0, shift);
    const auto wrapped = [](float x) { return x >= 1 ? x - 1 : x; };
    std::size_t blocked = 0;
    for (std::size_t place = 0; place < texels_.size(); ++place) {
        const Imath::V3f direction = texels_.cube_point(
            place, wrapped(texels_.jitter_column()[place] + shift.column[place % kPacketSize]),
            wrapped(texels_.jitter_row()[place] + shift.row[place % kPacketSize]));
        const bool hit = caster_.closest_hit(origin(), direction).has_value();
        EXPECT_EQ(hit, caster_.is_occluded(origin(), direction)) << place;
        EXPECT_EQ(found[place], hit ? 0.0F : 1.0F) << place;
        blocked += hit ? 1 : 0;
    }
    EXPECT_GT(blocked, texels_.size() / 20);
    EXPECT_LT(blocked, texels_.size() * 19 / 20);
    EXPECT_EQ(scratch_.rays, texels_.size());
}

TEST_F(VisibilityOfThinThings, AsksForNothingThatIsNotWanted) {
    for (std::size_t place = 0; place < texels_.size(); place += 2) {
        wanted_[place] = 0;
    }
    const auto found = open(4, JitterShift{});
    for (std::size_t place = 0; place < texels_.size(); place += 2) {
        EXPECT_EQ(found[place], 0);
    }
}

TEST_F(VisibilityOfThinThings, MoreRaysAtEdgesChangeTheNoiseAndNotTheMean) {
    constexpr int kPoints = 1000;
    std::vector<double> plain(texels_.size());
    std::vector<double> refined(texels_.size());
    double plain_squares = 0;
    double refined_squares = 0;
    for (std::uint64_t i = 0; i < kPoints; ++i) {
        const JitterShift shift = random_shift(i);
        const auto a = open(0, shift);
        const auto b = open(8, shift);
        for (std::size_t place = 0; place < a.size(); ++place) {
            plain[place] += a[place];
            refined[place] += b[place];
            plain_squares += a[place] * a[place];
            refined_squares += b[place] * b[place];
        }
    }
    // The difference of two means of a thousand has a standard deviation of at most 0.016.
    for (std::size_t place = 0; place < plain.size(); ++place) {
        EXPECT_NEAR(refined[place] / kPoints, plain[place] / kPoints, 0.08) << place;
    }
    const double mean = std::accumulate(plain.begin(), plain.end(), 0.0);
    EXPECT_NEAR(std::accumulate(refined.begin(), refined.end(), 0.0) / mean, 1, 3e-3);
    EXPECT_LT(refined_squares, plain_squares);
}

// Whether states of texels of a face that are within `reach` of one disagree, its own apart;
// where `beside` is set, of those in its row and column alone.
bool disagree(const LightTexels& texels,
              const std::vector<float>& first,
              std::size_t index,
              int reach,
              bool beside) {
    const auto n = static_cast<int>(texels.face_resolution());
    const auto face = static_cast<int>(index) / (n * n);
    const auto row = static_cast<int>(index) / n % n;
    const auto column = static_cast<int>(index) % n;
    bool any_open = false;
    bool any_blocked = false;
    for (int y = std::max(0, row - reach); y <= std::min(n - 1, row + reach); ++y) {
        for (int x = std::max(0, column - reach); x <= std::min(n - 1, column + reach); ++x) {
            const bool is_own = y == row && x == column;
            if (is_own || (beside && y != row && x != column)) {
                continue;
            }
            const auto at = static_cast<std::size_t>((face * n + y) * n + x);
            const bool is_open = first[texels.place_from_texel_index(at)] > 0;
            any_open = any_open || is_open;
            any_blocked = any_blocked || !is_open;
        }
    }
    return any_open && any_blocked;
}

TEST_F(VisibilityOfThinThings, MoreRaysGoWhereNeighboursDisagreeAndHalfAsManyAround) {
    const JitterShift shift = random_shift(3);
    const auto first = open(0, shift);
    scratch_.rays = 0;
    const auto refined = open(8, shift);
    std::size_t near = 0;
    std::size_t around = 0;
    for (std::size_t place = 0; place < texels_.size(); ++place) {
        const std::size_t index = texels_.texel_index(place);
        if (disagree(texels_, first, index, 1, true)) {
            ++near;
        } else if (disagree(texels_, first, index, 2, false)) {
            ++around;
        } else {
            EXPECT_EQ(refined[place], first[place]) << place;
        }
    }
    EXPECT_GT(near, 50U);
    EXPECT_GT(around, 50U);
    EXPECT_EQ(scratch_.rays, texels_.size() + 8 * near + 4 * around);
    scratch_.rays = 0;
    (void)open(8, shift, 0.3F);  // of what shows a third of itself
    EXPECT_EQ(scratch_.rays, texels_.size() + 3 * near + 2 * around);
}

TEST_F(VisibilityOfThinThings, RaysFromSeveralPlacesSeeTheMeanOfWhatEachSees) {
    const std::array<Imath::V3f, 2> ends{origin(), origin() + Imath::V3f(0.1F, 0, 0.06F)};
    std::array<Imath::V3f, kPacketSize> both;
    std::vector<double> found(texels_.size());
    std::vector<double> wanted(texels_.size());
    constexpr int kPoints = 600;
    std::vector<float> result(texels_.size());
    const Visibility visibility(caster_, texels_, 4);
    for (std::uint64_t i = 0; i < kPoints; ++i) {
        // Each lane is at either end in every other round, in an order of its own.
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            both[lane] = ends[(i + transport::mix_bits(i / 2 * kPacketSize + lane)) % 2];
        }
        visibility.compute(both, 1, random_shift(i), wanted_, result, scratch_);
        std::transform(found.begin(), found.end(), result.begin(), found.begin(),
                       [](double sum, float open) { return sum + double{open} / kPoints; });
        for (const Imath::V3f& end : ends) {
            std::array<Imath::V3f, kPacketSize> all;
            all.fill(end);
            visibility.compute(all, 1, random_shift(kPoints + i), wanted_, result, scratch_);
            std::transform(
                wanted.begin(), wanted.end(), result.begin(), wanted.begin(),
                [](double sum, float open) { return sum + double{open} / (2 * kPoints); });
        }
    }
    // Two means of rays that see one thing or the other: 0.5/√600 and 0.35/√600 at most.
    double chi_square = 0;
    for (std::size_t place = 0; place < found.size(); ++place) {
        EXPECT_NEAR(found[place], wanted[place], 0.12) << place;
        chi_square += std::pow(found[place] - wanted[place], 2);
    }
    EXPECT_LT(std::sqrt(chi_square / static_cast<double>(found.size())), 0.02);
}

}  // namespace
}  // namespace relume::bake
