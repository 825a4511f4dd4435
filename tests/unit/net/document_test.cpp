#include "server/net/rooms/document.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

constexpr ViewerId kAnna{1};
constexpr ViewerId kBert{2};

const wire::SceneSummary kScene{
    .name = "scene",
    .width = 96,
    .height = 64,
    .edits = {"environment", "rotation", "background", "strategy", "budget", "display"}};

light::EnvironmentMap constant_map(float value) {
    return {{16, 8, std::vector<float>(std::size_t{3} * 16 * 8, value)},
            light::Projection::lat_long};
}

class DocumentTest : public testing::Test {
  protected:
    DocumentTest() {
        library_.add_upload("map", constant_map(1));
        document_.emplace(kScene, library_.find("map"));
    }
    DocumentChange edit(ViewerId author, const json& patch, std::uint64_t id = 1) {
        return document_->edit(author, {.id = id, .patch = patch}, {}, {library_, materials_});
    }

    EnvironmentLibrary library_{EnvironmentBounds{}};
    MaterialLibrary materials_{0};
    std::optional<Document> document_;
};

TEST_F(DocumentTest, EachChangeSaysWhoMadeItAndWhatItTouches) {
    const DocumentChange first = edit(kAnna, {{"environment", {{"gain", 2}}}}, 17);
    EXPECT_EQ(first.revision, 1U);
    EXPECT_EQ(first.author, kAnna);
    EXPECT_EQ(first.edit_id, 17U);
    EXPECT_EQ(first.stages, wire::Stages(wire::Stage::signal));
    const DocumentChange second = edit(kBert, {{"display", {{"exposure_stops", 1}}}});
    EXPECT_EQ(second.revision, 2U);
    EXPECT_EQ(second.author, kBert);
    EXPECT_EQ(second.stages, wire::Stages(wire::Stage::display));
    EXPECT_EQ(document_->state().environment.gain, 2);
    EXPECT_EQ(document_->state().display.exposure_stops, 1);
}

TEST_F(DocumentTest, SectionsThatTheSceneDoesNotLetPeopleEditKeepTheirValues) {
    EXPECT_EQ(document_->state().image, (wire::ImageSize{.width = 96, .height = 64}));
    edit(kAnna, {{"image", {{"width", 96}}}, {"environment", {{"gain", 2}}}});
    EXPECT_EQ(document_->state().environment.gain, 2);
    const wire::RoomState before = document_->state();
    for (const json& patch : {json{{"environment", {{"gain", 3}}}, {"image", {{"width", 97}}}},
                              json{{"blend", {{"amount", 0.5}}}}}) {
        try {
            edit(kAnna, patch);
            ADD_FAILURE() << patch << " was taken";
        } catch (const wire::WireError& refusal) {
            EXPECT_EQ(refusal.code(), wire::ErrorCode::unsupported);
            EXPECT_EQ(refusal.path(), patch.contains("image") ? "/image" : "/blend");
        }
    }
    EXPECT_EQ(document_->state(), before);
    EXPECT_EQ(document_->revision(), 1U);
}

// Where people choose the size of the image, they choose one that can be drawn and held.
TEST_F(DocumentTest, ChosenImagesAreBounded) {
    wire::SceneSummary scene = kScene;
    scene.camera = wire::Camera{.eye = {1, 2, 3}, .look_at = {0, 1, 0}, .fov_degrees = 20};
    scene.edits = {"camera", "image"};
    document_.emplace(scene, library_.find("map"));
    EXPECT_EQ(document_->state().camera, *scene.camera);
    const auto size = [](std::uint32_t width, std::uint32_t height) {
        return json{{"image", {{"width", width}, {"height", height}}}};
    };
    EXPECT_EQ(edit(kAnna, size(4096, 2160)).stages, wire::Stages(wire::Stage::view));
    EXPECT_EQ(edit(kAnna, {{"camera", {{"eye", {5, 6, 7}}}}}).stages,
              wire::Stages(wire::Stage::view));
    const wire::RoomState before = document_->state();
    const auto refusal_of = [&](const json& patch) {
        try {
            edit(kAnna, patch);
        } catch (const wire::WireError& refusal) {
            return std::pair(refusal.code(), refusal.path());
        }
        return std::pair(wire::ErrorCode::internal, std::string("taken"));
    };
    EXPECT_EQ(refusal_of(size(4097, 1)),
              std::pair(wire::ErrorCode::out_of_range, std::string("/image/width")));
    EXPECT_EQ(refusal_of(size(1, 4097)),
              std::pair(wire::ErrorCode::out_of_range, std::string("/image/height")));
    EXPECT_EQ(refusal_of(size(4096, 2161)),
              std::pair(wire::ErrorCode::too_large, std::string("/image")));
    EXPECT_EQ(document_->state(), before);
}

TEST_F(DocumentTest, OnlySignalAndViewChangePixels) {
    edit(kAnna, {{"rotation", {{"yaw_degrees", 10}}}});
    EXPECT_EQ(document_->revision_of_pixels(), 1U);
    edit(kAnna, {{"display", {{"tone", "linear"}}}});
    edit(kAnna, {{"budget", {{"milliseconds", 20}}}});
    edit(kAnna, {{"strategy", {{"method", "nwa"}}}});
    edit(kAnna, json::object());
    EXPECT_EQ(document_->revision(), 5U);
    EXPECT_EQ(document_->revision_of_pixels(), 1U);
    edit(kAnna, {{"background", {{"mode", "transparent"}}}});
    EXPECT_EQ(document_->revision_of_pixels(), 6U);
}

TEST_F(DocumentTest, ARefusedEditLeavesNoTrace) {
    const wire::RoomState before = document_->state();
    EXPECT_THROW(edit(kAnna, {{"environment", {{"gain", 2}, {"name", "no-such-map"}}}}),
                 wire::WireError);
    EXPECT_THROW(edit(kAnna, {{"environment", {{"gain", -1}}}}), wire::WireError);
    EXPECT_EQ(document_->state(), before);
    EXPECT_EQ(document_->revision(), 0U);
    EXPECT_EQ(document_->environments().environment, library_.find("map"));
}

TEST_F(DocumentTest, AMapThatIsReplacedIsAChangeByNobody) {
    library_.add_upload("map", constant_map(2));
    const auto change = document_->environment_replaced("map", library_);
    ASSERT_TRUE(change);
    EXPECT_FALSE(change->author);
    EXPECT_FALSE(change->edit_id);
    EXPECT_EQ(change->patch, (json{{"environment", {{"name", "map"}}}}));
    EXPECT_EQ(change->stages, wire::Stages(wire::Stage::signal));
    EXPECT_EQ(document_->revision_of_pixels(), 1U);
    EXPECT_EQ(document_->environments().environment, library_.find("map"));
    EXPECT_FALSE(document_->environment_replaced("another", library_));
    EXPECT_EQ(document_->revision(), 1U);
}

}  // namespace
}  // namespace relume::net
