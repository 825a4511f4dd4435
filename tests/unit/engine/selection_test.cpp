#include "server/engine/selection.h"

#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace relume::engine {
namespace {

constexpr std::uint64_t kAnyBytes = ~std::uint64_t{0};

class SelectionTest : public testing::TestWithParam<wire::Priority> {
  protected:
    TinyScene tiny_;
    const Scene& scene_ = *tiny_.scene();
    Lighting lighting_{scene_};
    Selection selection_;

    [[nodiscard]] double importance(std::size_t j) const {
        const auto weights = scene_.weights(GetParam());
        double sum = 0;
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            const std::size_t i = c * scene_.coefficient_count() + j;
            const double weighted = double{weights[i]} * double{lighting_.target()[i]};
            sum += weighted * weighted;
        }
        return sum;
    }
};

TEST_P(SelectionTest, TakesTheMostImportantDifferences) {
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 5));
    std::vector<double> all(scene_.coefficient_count());
    for (std::size_t j = 0; j < all.size(); ++j) {
        all[j] = importance(j);
    }
    std::sort(all.rbegin(), all.rend());
    for (const std::uint32_t columns : {1U, 30U, 64U, 65U, 300U}) {
        selection_.choose(scene_, lighting_, scene_.weights(GetParam()), {columns, kAnyBytes});
        const auto changes = selection_.changes();
        ASSERT_EQ(changes.size(), columns);
        for (const ColumnChange& change : changes) {
            EXPECT_GE(importance(change.column), all[columns - 1] * (1 - 1e-5));
        }
        EXPECT_TRUE(std::is_sorted(changes.begin(), changes.end(), [&](auto& a, auto& b) {
            return std::pair(scene_.bands()[a.column], a.column) <
                   std::pair(scene_.bands()[b.column], b.column);
        }));
    }
}

TEST_P(SelectionTest, StaysWithinTheBytesButTakesOne) {
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 6));
    const std::uint64_t budget = scene_.transport().total_bytes() / 10;
    selection_.choose(scene_, lighting_, scene_.weights(GetParam()), {~0U, budget});
    EXPECT_LE(selection_.chosen_bytes(), budget);
    EXPECT_GT(selection_.chosen_bytes(), budget / 2);
    selection_.choose(scene_, lighting_, scene_.weights(GetParam()), {~0U, 0});
    EXPECT_EQ(selection_.changes().size(), 1U);
}

TEST_P(SelectionTest, EqualLightingHasNoDifferences) {
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 7));
    lighting_.apply_all();
    selection_.choose(scene_, lighting_, scene_.weights(GetParam()), {30, kAnyBytes});
    EXPECT_TRUE(selection_.changes().empty());
    EXPECT_EQ(selection_.differing_bytes(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Priorities,
                         SelectionTest,
                         testing::Values(wire::Priority::area,
                                         wire::Priority::none,
                                         wire::Priority::transport));

}  // namespace
}  // namespace relume::engine
