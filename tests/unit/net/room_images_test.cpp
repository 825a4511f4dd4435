// Which images a room makes, and what they show.
#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"
#include "protocol/wire/half_image.h"
#include "tests/unit/net/room_fixture.h"
#include "tests/unit/net/waiting.h"

#include <cmath>
#include <thread>

namespace relume::net {
namespace {

using nlohmann::json;

class RoomImagesTest : public RoomFixture {};

TEST_F(RoomImagesTest, TheSettledImageIsTheDenseProductOverTransparency) {
    const Seat viewer = enter(ImageInterest::settled);
    viewer.edit({{"background", {{"mode", "transparent"}}},
                 {"rotation", {{"yaw_degrees", 40}}},
                 {"environment", {{"gain", 3}}}});
    const SharedImageFrame frame = settled_image(viewer, 1);
    ASSERT_NE(frame, nullptr);
    EXPECT_TRUE(frame->header.exact);
    EXPECT_TRUE(frame->header.has_alpha);
    EXPECT_EQ(frame->header.relative_error, 0);
    EXPECT_EQ(frame->header.coefficients_remaining, 0U);

    const transport::Transport& transport = scenes_.find("tiny")->loaded->transport();
    const transport::TileGrid& image = transport.manifest().image();
    const std::uint32_t n = transport.manifest().signal_basis.cubemap().face_resolution();
    light::LightRig rig;
    rig.environment = environments_.find("map")->prefiltered(n);
    rig.rotation = Imath::Quatf(wire::quaternion_from_yaw_pitch_roll_degrees(40, 0, 0));
    rig.environment_scale = Imath::V3f(3);
    light::LightCubemap cubemap;
    light::evaluate(rig, n, cubemap);
    std::vector<float> lighting;
    light::lighting_coefficients(cubemap, scenes_.find("tiny")->loaded->projection(), lighting);
    std::vector<double> sums = test::dense_product(transport, lighting);
    test::receivers_from_sums(sums);

    const wire::HalfImage shown =
        wire::decode_half_image(std::span(frame->bytes).subspan(wire::kImageHeaderBytes),
                                image.width, image.height, true);
    double difference = 0;
    double norm = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const transport::ReceiverPlace at = image.place_from_pixel(x, y);
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

TEST_F(RoomImagesTest, ARestingRoomComputesNothing) {
    const Seat viewer = enter();
    ASSERT_NE(settled_image(viewer, 0), nullptr);
    const std::uint64_t slices = metrics_.slices();
    const std::uint64_t images = metrics_.images(wire::ImageEncoding::jpeg) +
                                 metrics_.images(wire::ImageEncoding::half_planes);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_EQ(metrics_.slices(), slices);
    EXPECT_EQ(metrics_.images(wire::ImageEncoding::jpeg) +
                  metrics_.images(wire::ImageEncoding::half_planes),
              images);
}

TEST_F(RoomImagesTest, NothingIsEncodedForClientsThatDoNotAcknowledge) {
    const Seat viewer = enter();
    ASSERT_NE(settled_image(viewer, 0), nullptr);
    // So small a budget that an image converges in many steps.
    viewer.edit({{"budget", {{"coefficients", 1}}}});
    // Two images go out; from then on nobody would take another.
    std::uint64_t gain = 1;
    EXPECT_TRUE(eventually([&] {
        while (viewer.outbox->take()) {
        }
        if (!viewer.outbox->wants_moving_image()) {
            return true;
        }
        viewer.edit({{"environment", {{"gain", ++gain}}}});
        return false;
    }));
    const std::uint64_t jpegs = metrics_.images(wire::ImageEncoding::jpeg);
    EXPECT_GT(jpegs, 0U);
    const std::uint64_t slices = metrics_.slices();
    viewer.edit({{"environment", {{"gain", ++gain}}}});
    EXPECT_TRUE(eventually([&] { return metrics_.slices() > slices; }));
    EXPECT_TRUE(
        eventually([&] { return !viewer.room->has_pending_edit(); }));  // its settled image
    EXPECT_EQ(metrics_.images(wire::ImageEncoding::jpeg), jpegs);
    viewer.room->acknowledge(viewer.viewer, 1'000'000);
    ASSERT_NE(settled_image(viewer, gain), nullptr);
}

TEST_F(RoomImagesTest, TargetErrorMetIsAtRestWithoutBeingExact) {
    const Seat viewer = enter(ImageInterest::settled);
    viewer.edit({{"budget", {{"coefficients", 4}, {"target_error", 0.3}}},
                 {"rotation", {{"yaw_degrees", 90}}}});
    const SharedImageFrame frame = settled_image(viewer, 1);
    ASSERT_NE(frame, nullptr);
    EXPECT_LE(frame->header.relative_error, 0.3F);
}

// What settled before and is sent again costs no relighting and no encoding, and has the same
// bits.
TEST_F(RoomImagesTest, ADisplayOrPolicyEditLeavesTheSettledImageBitForBit) {
    const Seat viewer = enter(ImageInterest::settled);
    viewer.edit({{"rotation", {{"yaw_degrees", 40}}}});
    const SharedImageFrame before = settled_image(viewer, 1);
    ASSERT_TRUE(before);
    const std::uint64_t slices = metrics_.slices();
    const std::uint64_t encoded = metrics_.images(wire::ImageEncoding::half_planes);
    std::uint64_t revision = 1;
    std::uint64_t sequence = before->header.sequence;
    for (const json& patch :
         {json{{"display", {{"exposure_stops", 1}}}}, json{{"display", {{"tone", "linear"}}}},
          json{{"budget", {{"milliseconds", 20}}}}, json{{"strategy", {{"method", "bi"}}}},
          json::object()}) {
        viewer.edit(patch);
        const SharedImageFrame after = settled_image(viewer, ++revision);
        ASSERT_TRUE(after) << patch;
        EXPECT_TRUE(after->header.exact);
        EXPECT_GT(after->header.sequence, sequence);
        sequence = after->header.sequence;
        EXPECT_EQ(payload_of(after), payload_of(before)) << patch;
    }
    EXPECT_EQ(metrics_.slices(), slices);
    EXPECT_EQ(metrics_.images(wire::ImageEncoding::half_planes), encoded);
    // Its header is one that clients take.
    const SharedImageFrame late = settled_image(enter(ImageInterest::settled), revision);
    ASSERT_TRUE(late);
    const wire::ImageHeader header = wire::decode_image_header(late->bytes);
    EXPECT_EQ(header.revision, revision);
    EXPECT_EQ(header.sequence, sequence);
    EXPECT_EQ(header.payload_bytes, late->bytes.size() - wire::kImageHeaderBytes);
}

// In rooms that never settle, so that JPEGs are all there is.
TEST_F(RoomImagesTest, ADisplayEditIsShownInAJpegWithoutRelighting) {
    RoomsOptions restless = options();
    restless.room.settle_delay = std::chrono::hours(1);
    const auto rooms =
        std::make_shared<Rooms>(scenes_, Libraries{environments_, materials_},
                                RoomThreads{workers_, encoders_}, metrics_, restless);
    const Seat viewer = enter(*rooms, ImageInterest::all, "r");
    const auto exact_jpeg = [&viewer](std::uint64_t revision) {
        SharedImageFrame found;
        EXPECT_TRUE(eventually([&] {
            const auto item = viewer.outbox->take();
            const auto* const frame = item ? std::get_if<SharedImageFrame>(&*item) : nullptr;
            if (frame != nullptr) {
                viewer.room->acknowledge(viewer.viewer, (*frame)->header.sequence);
                const bool is_it =
                    (*frame)->header.exact && (*frame)->header.revision == revision;
                found = is_it ? *frame : nullptr;
            }
            return found != nullptr;
        }));
        return found;
    };
    const SharedImageFrame before = exact_jpeg(0);
    ASSERT_TRUE(before);
    const std::uint64_t slices = metrics_.slices();
    viewer.edit({{"display", {{"exposure_stops", -1}}}});
    const SharedImageFrame after = exact_jpeg(1);
    ASSERT_TRUE(after);
    EXPECT_NE(payload_of(after), payload_of(before));
    EXPECT_EQ(metrics_.slices(), slices);
}

TEST_F(RoomImagesTest, AnotherBackgroundIsComposedAndNotRelit) {
    const Seat viewer = enter(ImageInterest::settled);
    const SharedImageFrame before = settled_image(viewer, 0);
    ASSERT_TRUE(before);
    const std::uint64_t slices = metrics_.slices();
    viewer.edit({{"background", {{"mode", "colour"}, {"colour", {3, 2, 1}}}}});
    const SharedImageFrame after = settled_image(viewer, 1);
    ASSERT_TRUE(after);
    EXPECT_NE(payload_of(after), payload_of(before));
    EXPECT_EQ(metrics_.slices(), slices);
}

// A policy that asks for more than the settled image holds is followed.
TEST_F(RoomImagesTest, ASmallerTargetErrorSettlesAnew) {
    const Seat viewer = enter(ImageInterest::settled);
    viewer.edit({{"budget", {{"coefficients", 4}, {"target_error", 0.3}}},
                 {"rotation", {{"yaw_degrees", 90}}}});
    const SharedImageFrame rough = settled_image(viewer, 1);
    ASSERT_TRUE(rough);
    ASSERT_FALSE(rough->header.exact) << "or there is nothing to make better";
    viewer.edit({{"budget", {{"target_error", 0}}}});
    const SharedImageFrame fine = settled_image(viewer, 2);
    ASSERT_TRUE(fine);
    EXPECT_TRUE(fine->header.exact);
    EXPECT_NE(payload_of(fine), payload_of(rough));
}

// Rooms of one scene that are edited at the same time are relit together: each shows what it
// would show if it were alone.
TEST_F(RoomImagesTest, RoomsEditedTogetherShowWhatTheyWouldAlone) {
    RoomsOptions many = options();
    many.room.limits.rooms = 20;
    const auto crowd =
        std::make_shared<Rooms>(scenes_, Libraries{environments_, materials_},
                                RoomThreads{workers_, encoders_}, metrics_, many);
    const auto enter_and_edit = [&](const std::string& name, std::size_t i) {
        Seat seat = enter(*crowd, ImageInterest::settled, name);
        seat.edit({{"environment", {{"gain", 0.5 + 0.25 * static_cast<double>(i)}}},
                   {"background", {{"mode", "colour"}, {"colour", {0, 0, 0}}}}});
        return seat;
    };
    std::vector<Seat> together;
    for (std::size_t i = 0; i < 9; ++i) {
        together.push_back(enter_and_edit("together" + std::to_string(i), i));
    }
    for (std::size_t i = 0; i < together.size(); ++i) {
        const auto frame = settled_image(together[i], 1);
        ASSERT_TRUE(frame);
        const auto expected = settled_image(enter_and_edit("alone" + std::to_string(i), i), 1);
        ASSERT_TRUE(expected);
        EXPECT_EQ(payload_of(frame), payload_of(expected)) << i;
    }
}

}  // namespace
}  // namespace relume::net
