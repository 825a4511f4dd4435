#include "server/engine/kernels/strip_product.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;
using transport::kStripSlots;
using transport::kStripsPerBlock;

constexpr std::size_t kColumns = 300;

// A run whose places hold no strip, one, an odd number and many.
template <typename Value>
struct Strips {
    std::array<std::uint32_t, kStripsPerBlock + 1> begins{};
    std::vector<std::uint16_t> columns;
    std::vector<Value> values;

    // Columns and values begin so many of them off the alignment of vectors.
    Strips(std::size_t misalignment, std::mt19937& random)
        : columns(misalignment), values(misalignment), misalignment_(misalignment) {
        constexpr std::array<std::uint32_t, 6> kCounts{0, 1, 2, 7, 64, 129};
        for (std::size_t place = 0; place < kStripsPerBlock; ++place) {
            begins[place + 1] = begins[place] + kCounts[random() % kCounts.size()];
        }
        for (std::size_t i = 0; i < begins.back(); ++i) {
            columns.push_back(static_cast<std::uint16_t>(random() % kColumns));
            for (std::size_t slot = 0; slot < kStripSlots; ++slot) {
                values.push_back(static_cast<Value>(static_cast<int>(random() % 256) - 128));
            }
        }
    }
    [[nodiscard]] StripRun<Value> run(float scale) const {
        return {.columns = columns.data() + misalignment_,
                .values = values.data() + misalignment_,
                .begins = begins,
                .scale = scale};
    }

  private:
    std::size_t misalignment_;
};

std::vector<float> random_floats(std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(-2, 2);
    std::vector<float> values(count);
    std::generate(values.begin(), values.end(), [&] { return uniform(random); });
    return values;
}

struct Members {
    std::size_t misalignment;
    std::vector<std::vector<float>> weights;
    std::vector<std::vector<float>> sums;

    Members(std::size_t count, std::size_t floats_off, std::mt19937& random)
        : misalignment(floats_off) {
        for (std::size_t m = 0; m < count; ++m) {
            weights.push_back(
                random_floats(misalignment + kColumns * kWeightsPerColumn, random));
            sums.push_back(random_floats(misalignment + kColours * kBlockSize + 1, random));
        }
    }
    std::vector<StripTarget> targets() {
        std::vector<StripTarget> targets;
        for (std::size_t m = 0; m < weights.size(); ++m) {
            targets.push_back({.weights = weights[m].data() + misalignment,
                               .sums = sums[m].data() + misalignment});
        }
        return targets;
    }
};

template <typename Value>
void expect_the_specification(MultiplyStrips<Value>& kernel,
                              MultiplyStrips<Value>& specification) {
    std::mt19937 random(5);
    // Every number of targets up to beyond a group, and a misalignment of its own for each.
    for (std::size_t count = 1; count <= 2 * 16; ++count) {
        const std::size_t misalignment = count % 16;
        const Strips<Value> strips(misalignment, random);
        const auto run = strips.run(count % 2 == 0 ? 256.0F : 1.0F);
        Members expected(count, misalignment, random);
        const Members before = expected;
        for (const StripTarget& target : expected.targets()) {  // each by itself
            specification(run, {&target, 1});
        }
        for (const int64_t instructions : hwy::SupportedAndGeneratedTargets()) {
            hwy::SetSupportedTargetsForTest(instructions);
            hwy::GetChosenTarget().DeInit();
            Members members = before;
            kernel(run, members.targets());
            EXPECT_EQ(members.sums, expected.sums)
                << count << " targets on " << hwy::TargetName(instructions);
        }
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
    }
}

TEST(StripProduct, EveryInstructionSetGivesEachTargetTheBitsOfTheSpecification) {
    expect_the_specification<std::int8_t>(multiply_strips, multiply_strips_scalar);
    expect_the_specification<float>(multiply_float_strips, multiply_float_strips_scalar);
}

TEST(StripProduct, SpecificationAddsScaleTimesWeightTimesValue) {
    const std::vector<std::uint16_t> columns{1, 0};
    const std::vector<std::int8_t> values{1, 2, 3, 4, 5, 6, 7, 8, -1, 0, 0, 0, 0, 0, 0, -128};
    std::array<std::uint32_t, kStripsPerBlock + 1> begins{};
    std::fill(begins.begin() + 4, begins.end(), 2U);  // both at place 3
    const std::vector<float> weights{10, 20, 30, 0, 1, 2, 3, 0};
    std::vector<float> sums(kColours * kBlockSize, 0.5F);
    const StripTarget target{.weights = weights.data(), .sums = sums.data()};
    multiply_strips_scalar(
        {.columns = columns.data(), .values = values.data(), .begins = begins, .scale = 2},
        {&target, 1});
    EXPECT_EQ(sums[24], 0.5F + 2 * (1 - 10));
    EXPECT_EQ(sums[31], 0.5F + 2 * (8 - 1280));
    EXPECT_EQ(sums[kBlockSize + 25], 0.5F + 2 * (2 * 2));
    EXPECT_EQ(sums[2 * kBlockSize + 30], 0.5F + 2 * (3 * 7));
    EXPECT_EQ(std::count(sums.begin(), sums.end(), 0.5F), 3 * 256 - 3 * 8);
}

}  // namespace
}  // namespace relume::engine
