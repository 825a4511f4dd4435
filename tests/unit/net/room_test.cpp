// What the people in a room see of one another's edits.
#include "tests/unit/net/room_fixture.h"

namespace relume::net {
namespace {

using nlohmann::json;

json last_change(const std::vector<json>& texts) {
    json last;
    for (const json& text : texts) {
        if (text["type"] == "change") {
            last = text;
        }
    }
    return last;
}

class RoomTest : public RoomFixture {};

TEST_F(RoomTest, EditsTakenTogetherMakeOneStateAndEveryViewerSeesIt) {
    const Seat author = enter();
    const Seat other = enter(ImageInterest::settled);
    ASSERT_EQ(author.room, other.room);
    for (int i = 1; i <= 50; ++i) {
        author.edit({{"environment", {{"gain", i}}}}, 100 + static_cast<unsigned>(i));
    }
    std::vector<json> author_texts;
    std::vector<json> other_texts;
    const SharedImageFrame first = settled_image(author, 50, &author_texts);
    const SharedImageFrame second = settled_image(other, 50, &other_texts);
    EXPECT_EQ(first, second);
    EXPECT_EQ(author_texts.front()["type"], "snapshot");
    const json last = last_change(author_texts);
    EXPECT_EQ(last["revision"], 50);
    EXPECT_EQ(last["edit_id"], 150);
    EXPECT_EQ(last["patch"], (json{{"environment", {{"gain", 50}}}}));
    EXPECT_EQ(last_change(other_texts)["revision"], 50);
    EXPECT_FALSE(last_change(other_texts).contains("edit_id"));
}

// One who reads nothing while another adds and removes lights of ever new names.
TEST_F(RoomTest, WhoReadsSlowlyHoldsOneSnapshotAndOneSmallChange) {
    const Seat author = enter(ImageInterest::settled);
    const Seat sleeper = enter(ImageInterest::settled);
    const json light{
        {"direction", {0, 1, 0}}, {"angular_radius_degrees", 5}, {"radiance", {1, 1, 1}}};
    std::uint64_t revision = 0;
    for (int round = 0; round < 40; ++round) {
        json add = json::object();
        json remove = json::object();
        json never_there = json::object();
        for (int i = 0; i < 20; ++i) {
            const std::string id = std::to_string(round) + "-" + std::to_string(i);
            add[id] = light;
            remove[id] = nullptr;
            never_there["never-" + id] = nullptr;
        }
        for (const json& lights : {add, remove, never_there}) {
            author.edit({{"lights", lights}}, ++revision);
        }
    }
    author.edit({{"lights", {{"last", light}}}}, ++revision);
    for (const Seat& seat : {author, sleeper}) {
        std::vector<json> texts;
        ASSERT_NE(settled_image(seat, revision, &texts), nullptr);
        std::erase_if(texts, [](const json& text) { return text["type"] == "viewers"; });
        ASSERT_GE(texts.size(), 1U);
        ASSERT_LE(texts.size(), 2U);
        EXPECT_EQ(texts.front()["type"], "snapshot");
        EXPECT_LT(texts.back().dump().size(), 300 * 200U);
        json state = texts.front()["state"];
        if (texts.size() == 2) {
            state.merge_patch(texts.back()["patch"]);
        }
        EXPECT_EQ(state["lights"].size(), 1U);
        EXPECT_EQ(texts.back()["revision"], revision);
        if (seat.viewer == author.viewer) {
            EXPECT_EQ(texts.back()["edit_id"], revision);
        }
    }
}

TEST_F(RoomTest, RefusedEditsLeaveEverythingAsItWas) {
    const Seat viewer = enter(ImageInterest::settled);
    const SharedImageFrame before = settled_image(viewer, 0);
    try {
        viewer.edit({{"environment", {{"gain", 2}, {"name", "no-such-map"}}}});
        FAIL() << "took an environment that does not exist";
    } catch (const wire::WireError& error) {
        EXPECT_EQ(error.code(), wire::ErrorCode::unknown_name);
        EXPECT_EQ(error.path(), "/environment/name");
        EXPECT_EQ(error.found(), "no-such-map");
    }
    EXPECT_THROW(viewer.edit({{"environment", {{"gain", -1}}}}), wire::WireError);
    const Seat late = enter(ImageInterest::settled);
    std::vector<json> texts;
    EXPECT_EQ(settled_image(late, 0, &texts), before);
    EXPECT_EQ(texts.front()["revision"], 0);
    EXPECT_EQ(texts.front()["state"]["environment"]["gain"], 1);
}

TEST_F(RoomTest, AnUploadThatReplacesANameRelightsTheRoomsThatItLights) {
    const auto constant_map = [](float value) {
        return light::EnvironmentMap(
            {16, 8, std::vector<float>(std::size_t{3} * 16 * 8, value)},
            light::Projection::lat_long);
    };
    environments_.when_replaced(
        [this](const std::string& name) { rooms_->environment_replaced(name); });
    environments_.add_upload("mine", constant_map(1));
    const std::uint64_t first_version = environments_.find("mine")->description().version;
    const Seat viewer = enter(ImageInterest::settled);
    viewer.edit({{"environment", {{"name", "mine"}}}});
    const SharedImageFrame before = settled_image(viewer, 1);
    ASSERT_NE(before, nullptr);

    environments_.add_upload("mine", constant_map(2));
    std::vector<json> texts;
    const SharedImageFrame after = settled_image(viewer, 2, &texts);
    ASSERT_NE(after, nullptr);
    EXPECT_TRUE(after->header.exact);
    EXPECT_NE(after->bytes, before->bytes);
    EXPECT_GT(environments_.find("mine")->description().version, first_version);
    ASSERT_FALSE(texts.empty());
    EXPECT_EQ(texts.front()["type"], "change");
    EXPECT_EQ(texts.front()["revision"], 2);
    EXPECT_EQ(texts.front()["patch"], (json{{"environment", {{"name", "mine"}}}}));

    // A name that lights nothing here changes nothing.
    environments_.add_upload("other", constant_map(1));
    environments_.add_upload("other", constant_map(2));
    viewer.edit({{"environment", {{"gain", 2}}}});
    EXPECT_NE(settled_image(viewer, 3), nullptr);
}

TEST_F(RoomTest, WithoutViewersARoomStandsStillAndGoesOnWhenOneComes) {
    const Seat viewer = enter();
    rooms_->leave(*viewer.room, viewer.viewer);
    viewer.edit({{"environment", {{"gain", 2}}}});
    EXPECT_FALSE(viewer.room->has_pending_edit());
    const Seat late = enter();
    EXPECT_NE(settled_image(late, 1), nullptr);
}

}  // namespace
}  // namespace relume::net
