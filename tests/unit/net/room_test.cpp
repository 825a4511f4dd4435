#include "server/net/rooms/room.h"

#include "protocol/wire/half_image.h"
#include "server/light/light_cubemap.h"
#include "server/light/light_rig.h"
#include "server/net/library/environment_library.h"
#include "server/net/rooms/rooms.h"
#include "tests/unit/net/tiny_scenes.h"
#include "tests/unit/net/waiting.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

light::EnvironmentMap half_bright_map() {
    light::MapImage image{.width = 32, .height = 16, .rgb = {}};
    for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
        const float radiance = i % image.width < 12 ? 2.0F : 0.25F;
        image.rgb.insert(image.rgb.end(), {radiance, radiance / 2, radiance / 4});
    }
    return {std::move(image), light::Projection::lat_long};
}

json last_change(const std::vector<json>& texts) {
    json last;
    for (const json& text : texts) {
        if (text["type"] == "change") {
            last = text;
        }
    }
    return last;
}

class RoomTest : public testing::Test {
  protected:
    RoomTest() {
        scenes_.refresh(folder_.path());
        environments_.add_upload("map", half_bright_map());
        rooms_ = std::make_shared<Rooms>(scenes_, environments_,
                                         RoomThreads{workers_, encoders_}, metrics_, options());
    }
    ~RoomTest() override {
        workers_.stop();
        encoders_.stop();
    }

    static RoomsOptions options() {
        RoomsOptions options;
        options.environment = "map";
        options.room.settle_delay = std::chrono::milliseconds(0);
        options.room.limits.clients_per_room = 3;
        options.room.limits.rooms = 2;
        return options;
    }
    static Room::SharedOutbox outbox(ImageInterest interest = ImageInterest::all) {
        return std::make_shared<Outbox>(interest, wire::Limits());
    }
    std::shared_ptr<Room> enter(const Room::SharedOutbox& viewer,
                                const std::string& name = "r") {
        return std::get<std::shared_ptr<Room>>(rooms_->enter(name, "tiny", viewer, "here"));
    }
    // Takes, and acknowledges, until a settled image comes; the text goes to `texts`.
    SharedImageFrame settled_image(Room& room,
                                   Outbox& viewer,
                                   std::uint64_t revision,
                                   std::vector<json>* texts = nullptr) {
        SharedImageFrame found;
        EXPECT_TRUE(eventually([&] {
            std::optional<Outbox::Item> item = viewer.take();
            if (!item) {
                return false;
            }
            if (const auto* const text = std::get_if<std::string>(&*item)) {
                if (texts != nullptr) {
                    texts->push_back(json::parse(*text));
                }
                return false;
            }
            const auto frame = std::get<SharedImageFrame>(*item);
            room.acknowledge(viewer, frame->header.sequence);
            if (frame->settled && frame->header.revision == revision) {
                found = frame;
            }
            return found != nullptr;
        }));
        return found;
    }
    static void edit(Room& room,
                     const Outbox& author,
                     const json& patch,
                     std::uint64_t id = 1) {
        room.edit(author, {.id = id, .patch = patch}, Clock::now());
    }

    TinyScenes folder_;
    Metrics metrics_;
    SceneLibrary scenes_;
    EnvironmentLibrary environments_{EnvironmentBounds{}};
    WorkerPool workers_{2, {.edits = 1, .refinements = 16}};
    WorkerPool encoders_{2, {}};
    std::shared_ptr<Rooms> rooms_;
};

TEST_F(RoomTest, TheSettledImageIsTheDenseProductOverTransparency) {
    const auto viewer = outbox(ImageInterest::settled);
    const auto room = enter(viewer);
    edit(*room, *viewer,
         {{"background", {{"mode", "transparent"}}},
          {"rotation", {{"yaw_degrees", 40}}},
          {"environment", {{"gain", 3}}}});
    const SharedImageFrame frame = settled_image(*room, *viewer, 1);
    ASSERT_NE(frame, nullptr);
    EXPECT_TRUE(frame->header.exact);
    EXPECT_TRUE(frame->header.has_alpha);
    EXPECT_EQ(frame->header.relative_error, 0);
    EXPECT_EQ(frame->header.coefficients_remaining, 0U);

    const transport::Transport& transport = scenes_.find("tiny")->engine->transport();
    const transport::TileGrid& image = transport.manifest().image;
    const std::uint32_t n = transport.manifest().light_basis.face_resolution();
    light::LightRig rig;
    rig.environment = environments_.find("map")->prefiltered(n);
    rig.rotation = Imath::Quatf(wire::quaternion_from_yaw_pitch_roll_degrees(40, 0, 0));
    rig.environment_scale = Imath::V3f(3);
    light::LightCubemap cubemap;
    light::evaluate(rig, n, cubemap);
    std::vector<float> lighting;
    light::lighting_coefficients(cubemap, scenes_.find("tiny")->engine->projection(), lighting);
    std::vector<double> sums = test::dense_product(transport, lighting);
    test::receivers_from_sums(sums);

    const wire::HalfImage shown =
        wire::decode_half_image(std::span(frame->bytes).subspan(wire::kImageHeaderBytes),
                                image.width, image.height, true);
    double difference = 0;
    double norm = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const transport::Receiver at = image.receiver_from_pixel(x, y);
            const std::size_t pixel = std::size_t{y} * image.width + x;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t i = (at.block * 3 + c) * transport::kBlockSize + at.slot;
                const double expected = sums[i] * static_cast<double>(transport.tint()[i]);
                const double found = shown.plane(c)[pixel];
                difference += (found - expected) * (found - expected);
                norm += expected * expected;
            }
            const float coverage =
                transport.coverage()[at.block * transport::kBlockSize + at.slot];
            EXPECT_NEAR(shown.plane(3)[pixel], coverage, 1e-3F);
        }
    }
    ASSERT_GT(norm, 0);
    EXPECT_LT(std::sqrt(difference / norm), 5e-4);  // a half's rounding
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
    const auto viewer = outbox(ImageInterest::settled);
    const auto room = enter(viewer);
    edit(*room, *viewer, {{"environment", {{"name", "mine"}}}});
    const SharedImageFrame before = settled_image(*room, *viewer, 1);
    ASSERT_NE(before, nullptr);

    environments_.add_upload("mine", constant_map(2));
    std::vector<json> texts;
    const SharedImageFrame after = settled_image(*room, *viewer, 2, &texts);
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
    edit(*room, *viewer, {{"environment", {{"gain", 2}}}});
    EXPECT_NE(settled_image(*room, *viewer, 3), nullptr);
}

TEST_F(RoomTest, EditsTakenTogetherMakeOneStateAndEveryViewerSeesIt) {
    const auto author = outbox();
    const auto other = outbox(ImageInterest::settled);
    const auto room = enter(author);
    ASSERT_EQ(enter(other), room);
    for (int i = 1; i <= 50; ++i) {
        edit(*room, *author, {{"environment", {{"gain", i}}}}, 100 + static_cast<unsigned>(i));
    }
    std::vector<json> author_texts;
    std::vector<json> other_texts;
    const SharedImageFrame first = settled_image(*room, *author, 50, &author_texts);
    const SharedImageFrame second = settled_image(*room, *other, 50, &other_texts);
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
    const auto author = outbox(ImageInterest::settled);
    const auto sleeper = outbox(ImageInterest::settled);
    const auto room = enter(author);
    ASSERT_EQ(enter(sleeper), room);
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
            edit(*room, *author, {{"lights", lights}}, ++revision);
        }
    }
    edit(*room, *author, {{"lights", {{"last", light}}}}, ++revision);
    for (const auto& viewer : {author, sleeper}) {
        std::vector<json> texts;
        ASSERT_NE(settled_image(*room, *viewer, revision, &texts), nullptr);
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
        if (viewer == author) {
            EXPECT_EQ(texts.back()["edit_id"], revision);
        }
    }
}

TEST_F(RoomTest, RefusedEditsLeaveEverythingAsItWas) {
    const auto viewer = outbox(ImageInterest::settled);
    const auto room = enter(viewer);
    const SharedImageFrame before = settled_image(*room, *viewer, 0);
    try {
        edit(*room, *viewer, {{"environment", {{"gain", 2}, {"name", "no-such-map"}}}});
        FAIL() << "took an environment that does not exist";
    } catch (const wire::WireError& error) {
        EXPECT_EQ(error.code(), wire::ErrorCode::unknown_name);
        EXPECT_EQ(error.path(), "/environment/name");
        EXPECT_EQ(error.found(), "no-such-map");
    }
    EXPECT_THROW(edit(*room, *viewer, {{"environment", {{"gain", -1}}}}), wire::WireError);
    const auto late = outbox(ImageInterest::settled);
    enter(late);
    std::vector<json> texts;
    EXPECT_EQ(settled_image(*room, *late, 0, &texts), before);
    EXPECT_EQ(texts.front()["revision"], 0);
    EXPECT_EQ(texts.front()["state"]["environment"]["gain"], 1);
}

TEST_F(RoomTest, ARestingRoomComputesNothing) {
    const auto viewer = outbox();
    const auto room = enter(viewer);
    ASSERT_NE(settled_image(*room, *viewer, 0), nullptr);
    const std::uint64_t steps = metrics_.steps();
    const std::uint64_t images = metrics_.images(wire::ImageEncoding::jpeg) +
                                 metrics_.images(wire::ImageEncoding::half_planes);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_EQ(metrics_.steps(), steps);
    EXPECT_EQ(metrics_.images(wire::ImageEncoding::jpeg) +
                  metrics_.images(wire::ImageEncoding::half_planes),
              images);
}

TEST_F(RoomTest, WithoutViewersARoomStandsStillAndGoesOnWhenOneComes) {
    const auto viewer = outbox();
    const auto room = enter(viewer);
    rooms_->leave(*room, viewer);
    edit(*room, *viewer, {{"environment", {{"gain", 2}}}});
    EXPECT_FALSE(room->has_pending_edit());
    const auto late = outbox();
    enter(late);
    EXPECT_NE(settled_image(*room, *late, 1), nullptr);
}

TEST_F(RoomTest, NothingIsEncodedForClientsThatDoNotAcknowledge) {
    const auto viewer = outbox();
    const auto room = enter(viewer);
    ASSERT_NE(settled_image(*room, *viewer, 0), nullptr);
    // So small a budget that an image converges in many steps.
    edit(*room, *viewer, {{"budget", {{"coefficients", 1}}}});
    // Two images go out; from then on nobody would take another.
    std::uint64_t gain = 1;
    EXPECT_TRUE(eventually([&] {
        while (viewer->take()) {
        }
        if (!viewer->wants_moving_image()) {
            return true;
        }
        edit(*room, *viewer, {{"environment", {{"gain", ++gain}}}});
        return false;
    }));
    const std::uint64_t jpegs = metrics_.images(wire::ImageEncoding::jpeg);
    EXPECT_GT(jpegs, 0U);
    const std::uint64_t steps = metrics_.steps();
    edit(*room, *viewer, {{"environment", {{"gain", ++gain}}}});
    EXPECT_TRUE(eventually([&] { return metrics_.steps() > steps; }));
    EXPECT_TRUE(eventually([&] { return !room->has_pending_edit(); }));  // its settled image
    EXPECT_EQ(metrics_.images(wire::ImageEncoding::jpeg), jpegs);
    viewer->acknowledge(1'000'000);
    ASSERT_NE(settled_image(*room, *viewer, gain), nullptr);
}

TEST_F(RoomTest, TargetErrorMetIsAtRestWithoutBeingExact) {
    const auto viewer = outbox(ImageInterest::settled);
    const auto room = enter(viewer);
    edit(*room, *viewer,
         {{"budget", {{"coefficients", 4}, {"target_error", 0.3}}},
          {"rotation", {{"yaw_degrees", 90}}}});
    const SharedImageFrame frame = settled_image(*room, *viewer, 1);
    ASSERT_NE(frame, nullptr);
    EXPECT_LE(frame->header.relative_error, 0.3F);
}

TEST_F(RoomTest, BoundsClientsAndRoomsAndNamesTheReason) {
    std::vector<Room::SharedOutbox> viewers;
    for (int i = 0; i < 3; ++i) {
        viewers.push_back(outbox());
        enter(viewers.back(), "a");
    }
    const auto more = outbox();
    EXPECT_EQ(std::get<wire::CloseCode>(rooms_->enter("a", "tiny", more, "here")),
              wire::CloseCode::room_full);
    EXPECT_EQ(std::get<wire::CloseCode>(rooms_->enter("b", std::nullopt, more, "here")),
              wire::CloseCode::unknown_scene);
    EXPECT_EQ(std::get<wire::CloseCode>(rooms_->enter("b", "none", more, "here")),
              wire::CloseCode::unknown_scene);
    EXPECT_EQ(std::get<wire::CloseCode>(rooms_->enter("a", "none", more, "here")),
              wire::CloseCode::unknown_scene);
    const auto b = enter(more, "b");
    const auto yet_another = outbox();
    EXPECT_EQ(std::get<wire::CloseCode>(rooms_->enter("c", "tiny", yet_another, "here")),
              wire::CloseCode::too_many_rooms);
    // A room that everybody left makes place.
    rooms_->leave(*b, more);
    EXPECT_NE(enter(yet_another, "c"), nullptr);
}

TEST_F(RoomTest, StoppedRoomsRefuseEditsAndGuests) {
    const auto viewer = outbox();
    const auto room = enter(viewer);
    rooms_->stop_edits();
    try {
        edit(*room, *viewer, json::object());
        FAIL() << "took an edit while shutting down";
    } catch (const wire::WireError& error) {
        EXPECT_EQ(error.code(), wire::ErrorCode::shutting_down);
    }
    EXPECT_EQ(std::get<wire::CloseCode>(rooms_->enter("r", "tiny", outbox(), "here")),
              wire::CloseCode::shutting_down);
}

// Rooms of one scene that are edited at the same time are relit together: each shows what it
// would show if it were alone.
TEST_F(RoomTest, RoomsEditedTogetherShowWhatTheyWouldAlone) {
    RoomsOptions many = options();
    many.room.limits.rooms = 20;
    const auto crowd = std::make_shared<Rooms>(
        scenes_, environments_, RoomThreads{workers_, encoders_}, metrics_, many);
    struct Seat {
        Room::SharedOutbox viewer = outbox(ImageInterest::settled);
        std::shared_ptr<Room> room;
        json patch;
    };
    const auto enter_and_edit = [&](Seat& seat, const std::string& name, std::size_t i) {
        seat.room =
            std::get<std::shared_ptr<Room>>(crowd->enter(name, "tiny", seat.viewer, "here"));
        seat.patch = {{"environment", {{"gain", 0.5 + 0.25 * static_cast<double>(i)}}},
                      {"background", {{"mode", "colour"}, {"colour", {0, 0, 0}}}}};
        edit(*seat.room, *seat.viewer, seat.patch);
    };
    std::vector<Seat> together(9);
    for (std::size_t i = 0; i < together.size(); ++i) {
        enter_and_edit(together[i], "together" + std::to_string(i), i);
    }
    for (std::size_t i = 0; i < together.size(); ++i) {
        const auto frame = settled_image(*together[i].room, *together[i].viewer, 1);
        ASSERT_TRUE(frame);
        Seat alone;
        enter_and_edit(alone, "alone" + std::to_string(i), i);
        const auto expected = settled_image(*alone.room, *alone.viewer, 1);
        ASSERT_TRUE(expected);
        const auto payload = [](const SharedImageFrame& image) {
            return std::vector(image->bytes.begin() + wire::kImageHeaderBytes,
                               image->bytes.end());
        };
        EXPECT_EQ(payload(frame), payload(expected)) << i;
    }
}

}  // namespace
}  // namespace relume::net
