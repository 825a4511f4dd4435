#include "server/net/rooms/audience.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace relume::net {
namespace {

using nlohmann::json;

const Clock::time_point kBegin = Clock::time_point() + std::chrono::hours(1);

class AudienceTest : public testing::Test {
  protected:
    std::shared_ptr<Outbox> join(std::uint64_t id,
                                 ImageInterest interest = ImageInterest::all,
                                 const std::string& address = "here") {
        auto outbox = std::make_shared<Outbox>(interest, wire::Limits());
        const auto refusal =
            audience_.join({.id = ViewerId{id}, .role = Role::editor}, outbox, address);
        return refusal ? nullptr : outbox;
    }
    // The next text, or null.
    static json next(Outbox& outbox) {
        const auto item = outbox.take();
        return item ? json::parse(std::get<std::string>(*item)) : json();
    }

    Metrics metrics_;
    Audience audience_{{.viewers = 4, .viewers_per_address = 2}, metrics_, kBegin};
};

TEST_F(AudienceTest, TheAuthorAloneGetsTheIdOfTheEditBack) {
    const auto author = join(1);
    const auto other = join(2);
    audience_.tell_change({.revision = 5,
                           .patch = {{"environment", {{"gain", 2}}}},
                           .author = ViewerId{1},
                           .edit_id = 17,
                           .stages = wire::Stage::signal},
                          [] { return nullptr; });
    EXPECT_EQ(next(*author)["edit_id"], 17);
    const json seen = next(*other);
    EXPECT_EQ(seen["revision"], 5);
    EXPECT_FALSE(seen.contains("edit_id"));
}

TEST_F(AudienceTest, BoundsItselfAndTheSeatsOfAnAddress) {
    EXPECT_TRUE(join(1));
    EXPECT_TRUE(join(2));
    const auto outbox = std::make_shared<Outbox>(ImageInterest::all, wire::Limits());
    const Viewer third{.id = ViewerId{3}, .role = Role::editor};
    EXPECT_EQ(audience_.join(third, outbox, "here"), Audience::Refusal::full_for_address);
    EXPECT_EQ(audience_.join(third, outbox, "there"), std::nullopt);
    EXPECT_TRUE(join(4, ImageInterest::all, "elsewhere"));
    EXPECT_EQ(audience_.join({.id = ViewerId{5}, .role = Role::editor}, outbox, "far"),
              Audience::Refusal::full);
    audience_.leave(ViewerId{1}, kBegin);
    EXPECT_TRUE(join(6)) << "a seat is given back";
}

TEST_F(AudienceTest, KnowsSinceWhenItIsEmpty) {
    EXPECT_EQ(audience_.empty_since(), kBegin);
    EXPECT_TRUE(join(1));
    EXPECT_EQ(audience_.empty_since(), std::nullopt);
    const auto later = kBegin + std::chrono::seconds(5);
    audience_.leave(ViewerId{7}, later);
    EXPECT_EQ(audience_.empty_since(), std::nullopt) << "who is not here cannot leave";
    audience_.leave(ViewerId{1}, later);
    EXPECT_EQ(audience_.empty_since(), later);
}

TEST_F(AudienceTest, WantsMovingImagesInTheFormsOfThoseWhoDo) {
    EXPECT_FALSE(audience_.wants_moving_image());
    EXPECT_TRUE(join(1, ImageInterest::settled));
    EXPECT_FALSE(audience_.wants_moving_image());
    EXPECT_TRUE(audience_.moving_forms().displays.empty());
    const auto bright = join(2);
    bright->choose_display({.exposure_stops = 3, .tone = {}});
    EXPECT_TRUE(join(3, ImageInterest::moving_float, "there"));
    EXPECT_TRUE(audience_.wants_moving_image());
    EXPECT_TRUE(audience_.moving_forms().half_planes);
    ASSERT_EQ(audience_.moving_forms().displays.size(), 1U);
    EXPECT_EQ(audience_.moving_forms().displays.front(), bright->display());
}

}  // namespace
}  // namespace relume::net
