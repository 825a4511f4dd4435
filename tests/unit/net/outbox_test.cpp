#include "server/net/rooms/outbox.h"

#include "server/net/images/image_forms.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace relume::net {
namespace {

using nlohmann::json;

wire::Limits limits() {
    wire::Limits limits;
    limits.images_in_flight = 2;
    return limits;
}

SharedImageFrame image(std::uint64_t sequence,
                       wire::ImageEncoding encoding = wire::ImageEncoding::jpeg) {
    auto frame = std::make_shared<ImageFrame>();
    frame->header.sequence = sequence;
    frame->header.encoding = encoding;
    return frame;
}

json taken_text(Outbox& outbox) {
    const std::optional<Outbox::Item> item = outbox.take();
    const std::string* const text = item ? std::get_if<std::string>(&*item) : nullptr;
    return text == nullptr ? json() : json::parse(*text);
}

std::uint64_t taken_sequence(Outbox& outbox) {
    const std::optional<Outbox::Item> item = outbox.take();
    const SharedImageFrame* const frame =
        item ? std::get_if<SharedImageFrame>(&*item) : nullptr;
    return frame == nullptr ? 0 : (*frame)->header.sequence;
}

TEST(Outbox, TheNewestImageReplacesAnUnsentOne) {
    Outbox outbox(ImageInterest::all, limits());
    EXPECT_FALSE(outbox.put_image(image(1)));
    EXPECT_TRUE(outbox.put_image(image(2)));
    EXPECT_TRUE(outbox.put_image(image(3)));
    EXPECT_EQ(taken_sequence(outbox), 3U);
    EXPECT_FALSE(outbox.take().has_value());
}

TEST(Outbox, NoMoreThanTheBoundIsInFlight) {
    Outbox outbox(ImageInterest::all, limits());
    outbox.put_image(image(1));
    EXPECT_EQ(taken_sequence(outbox), 1U);
    outbox.put_image(image(2));
    EXPECT_EQ(taken_sequence(outbox), 2U);
    EXPECT_FALSE(outbox.wants_moving_image());
    outbox.put_image(image(3));
    EXPECT_FALSE(outbox.take().has_value());
    outbox.put_image(image(4));
    outbox.acknowledge(1);
    EXPECT_EQ(taken_sequence(outbox), 4U);
    EXPECT_FALSE(outbox.take().has_value());
}

TEST(Outbox, AnAcknowledgementCountsForAllBefore) {
    Outbox outbox(ImageInterest::all, limits());
    for (const std::uint64_t sequence : {5U, 9U}) {
        outbox.put_image(image(sequence));
        EXPECT_EQ(taken_sequence(outbox), sequence);
    }
    outbox.acknowledge(4);
    EXPECT_FALSE(outbox.wants_moving_image());
    outbox.acknowledge(9);
    EXPECT_TRUE(outbox.wants_moving_image());
    outbox.put_image(image(10));
    EXPECT_TRUE(outbox.wants_moving_image());
}

TEST(Outbox, SettledInterestWantsNoMovingImage) {
    EXPECT_FALSE(Outbox(ImageInterest::settled, limits()).wants_moving_image());
    EXPECT_TRUE(Outbox(ImageInterest::all, limits()).wants_moving_image());
    EXPECT_TRUE(Outbox(ImageInterest::moving_float, limits()).wants_moving_image());
}

TEST(ImageFrames, EveryViewerGetsTheFormHeAskedFor) {
    const wire::DisplayChoice bright{.exposure_stops = 2, .tone = {}};
    const wire::DisplayChoice linear{.exposure_stops = {}, .tone = wire::Tone::linear};
    ImageFrames frames;
    frames.jpegs = {{.display = bright, .frame = image(1)}, {.display = {}, .frame = image(1)}};
    frames.half_planes = image(1, wire::ImageEncoding::half_planes);
    EXPECT_EQ(frames.for_viewer(ImageInterest::all, bright), frames.jpegs[0].frame);
    EXPECT_EQ(frames.for_viewer(ImageInterest::all, {}), frames.jpegs[1].frame);
    EXPECT_EQ(frames.for_viewer(ImageInterest::all, linear), frames.jpegs[1].frame);
    EXPECT_EQ(frames.for_viewer(ImageInterest::moving_float, bright), frames.half_planes);
    EXPECT_EQ(frames.for_viewer(ImageInterest::settled, {}), nullptr);
    frames.jpegs.clear();
    frames.settled = true;
    for (const ImageInterest interest :
         {ImageInterest::all, ImageInterest::settled, ImageInterest::moving_float}) {
        EXPECT_EQ(frames.for_viewer(interest, bright), frames.half_planes);
    }
}

TEST(ImageForms, AreBoundedAndTheRoomsDisplayIsAmongThemWhereTheyDoNotSuffice) {
    ImageForms forms;
    for (int stops = 1; stops <= 9; ++stops) {
        forms.add({.exposure_stops = stops, .tone = {}});
        forms.add({.exposure_stops = 1, .tone = {}});
    }
    ASSERT_EQ(forms.displays.size(), ImageForms::kMostDisplays);
    EXPECT_EQ(forms.displays.front().exposure_stops, 1);
    EXPECT_EQ(forms.displays.back(), wire::DisplayChoice{});
}

TEST(Outbox, UnsentChangesMergeAndKeepTheLastRevision) {
    Outbox outbox(ImageInterest::all, limits());
    EXPECT_TRUE(outbox.put_change(
        {.revision = 4,
         .patch = {{"environment", {{"gain", 2}}}, {"lights", {{"a", nullptr}}}},
         .edit_id = 17}));
    EXPECT_TRUE(outbox.put_change(
        {.revision = 5, .patch = {{"environment", {{"gain", 3}}}}, .edit_id = {}}));
    const json change = taken_text(outbox);
    EXPECT_EQ(change["type"], "change");
    EXPECT_EQ(change["revision"], 5);
    EXPECT_EQ(change["edit_id"], 17);
    EXPECT_EQ(change["patch"],
              (json{{"environment", {{"gain", 3}}}, {"lights", {{"a", nullptr}}}}));
    EXPECT_FALSE(outbox.take().has_value());
}

// Who reads slowly holds one change of bounded size, whatever the others add and remove.
TEST(Outbox, AChangeThatWouldGrowGivesWayToASnapshot) {
    const auto lights = [](std::size_t first, std::size_t count) {
        json named = json::object();
        for (std::size_t i = first; i < first + count; ++i) {
            named["light-" + std::to_string(i)] = nullptr;
        }
        return json{{"lights", named}};
    };
    Outbox outbox(ImageInterest::all, limits());
    // However much one edit names, it is one edit.
    EXPECT_TRUE(outbox.put_change(
        {.revision = 1, .patch = lights(0, Outbox::kMaxMergedLights), .edit_id = 5}));
    // The same lights again are no more lights.
    EXPECT_TRUE(outbox.put_change({.revision = 2, .patch = lights(0, 9), .edit_id = {}}));
    EXPECT_FALSE(outbox.put_change(
        {.revision = 3, .patch = lights(Outbox::kMaxMergedLights, 1), .edit_id = {}}));
    auto snapshot = std::make_shared<wire::Snapshot>();
    snapshot->revision = 3;
    outbox.put_snapshot(snapshot);
    EXPECT_TRUE(outbox.put_change(
        {.revision = 4, .patch = {{"environment", {{"gain", 2}}}}, .edit_id = {}}));
    EXPECT_EQ(taken_text(outbox)["revision"], 3);
    const json change = taken_text(outbox);
    EXPECT_EQ(change["revision"], 4);
    EXPECT_EQ(change["patch"], (json{{"environment", {{"gain", 2}}}}));
    EXPECT_EQ(change["edit_id"], 5) << "its author waits for it";
    EXPECT_FALSE(outbox.take().has_value());
}

TEST(Outbox, AnEditThatASnapshotHoldsIsConfirmedAfterIt) {
    Outbox outbox(ImageInterest::all, limits());
    outbox.put_snapshot(std::make_shared<const wire::Snapshot>());
    outbox.confirm(7, 12);
    EXPECT_EQ(taken_text(outbox)["type"], "snapshot");
    const json change = taken_text(outbox);
    EXPECT_EQ(change["revision"], 7);
    EXPECT_EQ(change["edit_id"], 12);
    EXPECT_EQ(change["patch"], json::object());
}

TEST(Outbox, SnapshotComesFirstAndTextBeforeImages) {
    Outbox outbox(ImageInterest::all, limits());
    outbox.put_image(image(1));
    outbox.put_viewers(1);
    outbox.put_viewers(2);
    outbox.put_snapshot(std::make_shared<const wire::Snapshot>());
    EXPECT_TRUE(outbox.put_change({.revision = 1, .patch = json::object(), .edit_id = {}}));
    EXPECT_EQ(taken_text(outbox)["type"], "snapshot");
    EXPECT_EQ(taken_text(outbox)["type"], "change");
    EXPECT_EQ(taken_text(outbox)["count"], 2);
    EXPECT_EQ(taken_sequence(outbox), 1U);
}

TEST(Outbox, OfUnsentErrorsTheNewestAreKept) {
    Outbox outbox(ImageInterest::all, limits());
    for (std::uint64_t id = 0; id <= wire::Limits().errors_per_connection; ++id) {
        wire::ErrorMessage error;
        error.edit_id = id;
        outbox.put_error(error);
    }
    for (std::uint64_t id = 1; id <= wire::Limits().errors_per_connection; ++id) {
        EXPECT_EQ(taken_text(outbox)["edit_id"], id);
    }
    EXPECT_FALSE(outbox.take().has_value());
}

TEST(Outbox, ShuttingDownSendsTheImageFirstAndOtherClosesDoNot) {
    Outbox patient(ImageInterest::all, limits());
    patient.put_image(image(7));
    patient.close(wire::CloseCode::shutting_down);
    EXPECT_EQ(taken_sequence(patient), 7U);
    EXPECT_TRUE(std::holds_alternative<Outbox::Close>(patient.take().value()));

    Outbox strict(ImageInterest::all, limits());
    strict.put_image(image(7));
    strict.close(wire::CloseCode::too_fast);
    strict.close(wire::CloseCode::bye);
    const std::optional<Outbox::Item> item = strict.take();
    ASSERT_TRUE(item.has_value());
    EXPECT_EQ(std::get<Outbox::Close>(*item).code, wire::CloseCode::too_fast);
}

TEST(Outbox, WakesOnceForATakerThatFoundNothing) {
    int wakes = 0;
    Outbox outbox(ImageInterest::all, limits());
    outbox.set_wake([&wakes] { ++wakes; });
    outbox.put_viewers(1);
    EXPECT_EQ(wakes, 0);  // nobody has asked yet
    static_cast<void>(outbox.take());
    EXPECT_FALSE(outbox.take().has_value());
    outbox.put_viewers(2);
    outbox.put_viewers(3);
    EXPECT_EQ(wakes, 1);
}

}  // namespace
}  // namespace relume::net
