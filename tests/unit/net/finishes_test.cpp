// Parts of a scene that are given other materials than they were baked with.
#include "protocol/wire/room_patch.h"
#include "server/net/rooms/document.h"
#include "server/net/rooms/relighter.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_mesh.h"
#include "tests/unit/net/small_materials.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

constexpr std::uint32_t kResolution = 4;
constexpr std::uint32_t kParts = 6;

// A scene whose transport is of n = 8 and whose visibility is of n = 4, and three materials.
class FinishesTest : public testing::Test {
  protected:
    FinishesTest() {
        test::write_tiny_mesh_transport(folder_.path() / "room.relume", 1, kResolution);
        scenes_.refresh(folder_.path());
        write_small_material(folder_.path(), "white", materials::lambert_model());
        write_small_material(folder_.path(), "phong-exponent-4", materials::phong_model(4));
        write_small_material(folder_.path(), "phong-exponent-16", materials::phong_model(16));
        write_small_material(folder_.path(), "fine", materials::lambert_model(), 8);
        materials_.refresh(folder_.path());
        environments_.add_upload("grey",
                                 {{16, 8, std::vector<float>(std::size_t{3} * 16 * 8, 0.5F)},
                                  light::Projection::lat_long});
    }

    // A room: its document, and the images of it.
    class Room {
      public:
        explicit Room(FinishesTest& test)
            : test_(test),
              document_(test.scenes_.find("room")->summary(), test.environments_.find("grey")),
              relighter_(test.scenes_.find("room"), test.metrics_, std::chrono::seconds(1)) {
            show(kAllStages);
        }

        void edit(const json& patch) {
            const DocumentChange change =
                document_.edit(ViewerId{1}, {.id = 1, .patch = patch}, {},
                               {test_.environments_, test_.materials_});
            show(change.stages);
        }
        void show(wire::Stages stages) {
            EXPECT_TRUE(relighter_
                            .set_state(document_.state(), document_.environments(),
                                       document_.finishes(), stages)
                            .empty());
        }
        void relight() {
            Relighter* const self = &relighter_;
            while (!self->at_rest()) {
                Relighter::advance_together({&self, 1});
            }
        }
        // Linear, planes of red, green and blue.
        [[nodiscard]] std::vector<float> picture(bool settled = true) {
            relight();
            ImageStamp stamp;
            stamp.settled = settled;
            const Picture picture =
                relighter_.picture(stamp, {.displays = {}, .half_planes = true}, 0);
            EXPECT_TRUE(picture.header.exact);
            EXPECT_EQ(picture.header.relative_error, 0);
            EXPECT_EQ(picture.header.coefficients_remaining, 0U);
            std::vector<float> values;
            for (const auto value : picture.composer->half_image().values) {
                values.push_back(float{value});
            }
            return values;
        }
        [[nodiscard]] const Document& document() const { return document_; }
        [[nodiscard]] Relighter& relighter() { return relighter_; }

      private:
        FinishesTest& test_;
        Document document_;
        Relighter relighter_;
    };

    [[nodiscard]] static json all_parts(const json& finish) {
        json finishes;
        for (std::uint32_t part = 0; part < kParts; ++part) {
            finishes["material" + std::to_string(part)] = finish;
        }
        return {{"finishes", finishes}};
    }
    // What is edited in these tests: black behind the scene.
    [[nodiscard]] static json begin() {
        return {{"background", {{"mode", "colour"}, {"colour", {0, 0, 0}}}},
                {"lights",
                 {{"key",
                   {{"direction", {0.3, 1, 0.2}},
                    {"angular_radius_degrees", 40},
                    {"radiance", {9, 8, 7}}}}}}};
    }

    test::ScratchDirectory folder_;
    SceneLibrary scenes_;
    EnvironmentLibrary environments_{EnvironmentBounds{}};
    MaterialLibrary materials_{std::size_t{1} << 20};
    Metrics metrics_;
};

const json kWhiteFloor = {{"finishes", {{"material2", {{"material", "white"}}}}}};
const json kGlossyWall = {
    {"finishes", {{"material1", {{"material", "phong"}, {"parameter", 9}}}}}};

TEST_F(FinishesTest, TheSceneNamesItsPartsAndWhatTheySeeOfTheLight) {
    const wire::SceneSummary scene = scenes_.find("room")->summary();
    EXPECT_EQ(scene.visibility_resolution, kResolution);
    ASSERT_EQ(scene.parts.size(), kParts);
    EXPECT_EQ(scene.parts[3], (wire::ScenePart{.id = "material3", .name = "material3"}));
    EXPECT_EQ(std::count(scene.edits.begin(), scene.edits.end(), "finishes"), 1);
    EXPECT_EQ(wire::scene_summary_from_json(wire::to_json(scene), ""), scene);
}

// There and back gives the same bits, in whatever order.
TEST_F(FinishesTest, WhatIsTakenBackLeavesNoTrace) {
    Room plain(*this);
    plain.edit(begin());
    const auto as_baked = plain.picture();

    Room room(*this);
    room.edit(begin());
    room.edit(kGlossyWall);
    const auto glossy = room.picture();
    EXPECT_NE(glossy, as_baked);
    room.edit(kWhiteFloor);
    const auto both = room.picture();
    EXPECT_NE(both, glossy);
    room.edit({{"lights", {{"key", {{"direction", {1, 0.2, 0}}}}}}});
    EXPECT_NE(room.picture(), both);
    room.edit({{"lights", {{"key", {{"direction", {0.3, 1, 0.2}}}}}}});
    EXPECT_EQ(room.picture(), both);
    room.edit({{"finishes", {{"material2", nullptr}}}});
    EXPECT_EQ(room.picture(), glossy);
    room.edit({{"finishes", {{"material1", nullptr}}}});
    EXPECT_EQ(room.picture(), as_baked);

    Room other(*this);
    other.edit(kWhiteFloor);
    other.edit(kGlossyWall);
    other.edit(begin());
    EXPECT_EQ(other.picture(), both);
}

TEST_F(FinishesTest, OtherPartsStayAsTheyAre) {
    Room room(*this);
    room.edit(begin());
    const auto before = room.picture(false);
    room.edit(kWhiteFloor);
    const auto after = room.picture(false);
    room.edit({{"finishes", {{"material2", {{"colours", {{0, 0, 0}}}}}}}});
    const auto black = room.picture(false);
    std::size_t of_floor = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (after[i] == before[i]) {
            EXPECT_EQ(black[i], before[i]);
        } else {
            EXPECT_EQ(black[i], 0);
            ++of_floor;
        }
    }
    EXPECT_GT(of_floor, before.size() / 20);
    EXPECT_LT(of_floor, before.size() / 2);
}

// The camera moves, and light with it: at rest the image is that of a room that began there.
TEST_F(FinishesTest, ViewsAreThoseOfARoomThatBeganThere) {
    Room room(*this);
    room.edit(begin());
    room.edit(kWhiteFloor);
    room.edit(kGlossyWall);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-0.9, 0.9);
    const auto near = [&] {
        return json{10 + place(random), 20 + place(random), 30 + place(random)};
    };
    for (int i = 0; i < 60; ++i) {
        const json patch = {{"camera", {{"eye", near()}, {"look_at", near()}}},
                            {"rotation", {{"yaw_degrees", 7 * i}}},
                            {"image", {{"width", 20 + i}, {"height", 30}}}};
        room.edit(patch);
        if (i % 3 != 0) {
            continue;  // edits that nobody waits for
        }
        const auto moved = room.picture();
        Room fresh(*this);
        fresh.edit(begin());
        fresh.edit(kGlossyWall);
        fresh.edit(kWhiteFloor);
        fresh.edit(patch);
        ASSERT_EQ(moved, fresh.picture()) << i;
    }
}

// A part's image is linear in light and colour, and nothing of the transport's where all parts
// are given materials.
TEST_F(FinishesTest, ImagesAreLinearInLightAndColours) {
    Room room(*this);
    room.edit(begin());
    room.edit(all_parts({{"material", "white"}}));
    const auto once = room.picture();
    room.edit({{"environment", {{"gain", 2}}}, {"lights", {{"key", {{"gain", 2}}}}}});
    const auto bright = room.picture();
    room.edit({{"environment", {{"gain", 1}}}, {"lights", {{"key", {{"gain", 1}}}}}});
    room.edit(all_parts({{"colours", {{2, 2, 2}}}}));
    const auto white = room.picture();
    double sum = 0;
    for (std::size_t i = 0; i < once.size(); ++i) {
        sum += once[i];
        EXPECT_NEAR(bright[i], 2 * once[i], 2e-3F * bright[i] + 1e-6F);
        EXPECT_NEAR(white[i], bright[i], 2e-3F * bright[i] + 1e-6F);
    }
    EXPECT_GT(sum, 0.1 * static_cast<double>(once.size()));
}

// Between two exponents of Phong the image is their mean, by the exponent's logarithm.
TEST_F(FinishesTest, BetweenTwoStepsTheImageIsAMixture) {
    Room room(*this);
    room.edit(begin());
    const auto at = [&](double exponent) {
        room.edit(all_parts({{"material", "phong"}, {"parameter", exponent}}));
        return room.picture();
    };
    const auto soft = at(4);
    const auto sharp = at(16);
    const auto between = at(8);
    EXPECT_NE(soft, sharp);
    for (std::size_t i = 0; i < soft.size(); ++i) {
        EXPECT_NEAR(between[i], (soft[i] + sharp[i]) / 2, 2e-3F * between[i] + 1e-6F);
    }
}

// Where no pixel shows the transport, nothing of it is relit.
TEST_F(FinishesTest, ATransportThatNobodySeesRests) {
    Room room(*this);
    room.edit(begin());
    room.edit(all_parts({{"material", "white"}}));
    static_cast<void>(room.picture());
    const std::uint64_t slices = metrics_.slices();
    room.edit({{"rotation", {{"yaw_degrees", 90}}}});
    const auto turned = room.picture();
    EXPECT_EQ(metrics_.slices(), slices);
    room.edit({{"finishes", {{"material0", nullptr}}}});
    EXPECT_NE(room.picture(), turned);
    EXPECT_GT(metrics_.slices(), slices);
}

TEST_F(FinishesTest, ImagesWaitUntilTheyAreWhole) {
    Room room(*this);
    room.edit(begin());
    room.edit(kWhiteFloor);
    EXPECT_FALSE(room.relighter().step_is_complete());
    EXPECT_FALSE(room.relighter().at_rest());
    EXPECT_GT(room.relighter().stated_error(), 0);
    room.relight();
    EXPECT_TRUE(room.relighter().step_is_complete());
    EXPECT_EQ(room.relighter().stated_error(), 0);
}

class FinishEditsTest : public FinishesTest {
  protected:
    void refuses(const json& finishes,
                 wire::ErrorCode code,
                 const std::string& path,
                 const std::string& expected) {
        const wire::RoomState before = room_.document().state();
        try {
            room_.edit({{"finishes", finishes}});
            ADD_FAILURE() << finishes << " was taken";
        } catch (const wire::WireError& refusal) {
            EXPECT_EQ(refusal.code(), code) << refusal.what();
            EXPECT_EQ(refusal.path(), path) << refusal.what();
            EXPECT_NE(refusal.expected().find(expected), std::string::npos)
                << refusal.expected();
        }
        EXPECT_EQ(room_.document().state(), before);
    }

    Room room_{*this};
};

TEST_F(FinishEditsTest, WhatDoesNotFitIsRefusedAndLosesNothing) {
    using wire::ErrorCode;
    room_.edit(kGlossyWall);
    const json white = {{"material", "white"}};
    refuses({{"material9", white}}, ErrorCode::unknown_name, "/finishes/material9",
            "material1");
    refuses({{"material0", {{"material", "wite"}}}}, ErrorCode::unknown_name,
            "/finishes/material0/material", "white");
    refuses({{"material0", {{"material", "fine"}}}}, ErrorCode::unknown_name,
            "/finishes/material0/material", "4×4 texels a face");
    refuses({{"material0", {{"colours", {{1, 1, 1}}}}}}, ErrorCode::missing_field,
            "/finishes/material0/material", "");
    refuses({{"material0", {{"material", "white"}, {"colours", {{1, 1, 1}, {1, 0, 0}}}}}},
            ErrorCode::out_of_range, "/finishes/material0/colours", "1, one a lobe of white");
    refuses({{"material0", {{"material", "white"}, {"parameter", 3}}}}, ErrorCode::unsupported,
            "/finishes/material0/parameter", "no family");
    refuses({{"material1", {{"parameter", 17}}}}, ErrorCode::out_of_range,
            "/finishes/material1/parameter", "exponent from 4 to 16");
    refuses({{"material0", white}, {"material1", {{"parameter", 3.9}}}},
            ErrorCode::out_of_range, "/finishes/material1/parameter", "exponent from 4 to 16");
}

TEST_F(FinishEditsTest, AnotherMaterialComesWithItsOwnNumberAndColours) {
    room_.edit(kGlossyWall);
    room_.edit({{"finishes", {{"material1", {{"colours", {{1, 0, 0}}}}}}}});
    const auto wall = [&] { return room_.document().state().finishes.at("material1"); };
    EXPECT_EQ(wall().parameter, 9);
    EXPECT_TRUE(wall().colours);
    room_.edit({{"finishes", {{"material1", {{"material", "phong"}}}}}});  // it is that already
    EXPECT_EQ(wall().parameter, 9);
    room_.edit({{"finishes", {{"material1", {{"material", "white"}}}}}});
    EXPECT_FALSE(wall().parameter);
    EXPECT_FALSE(wall().colours);
}

// A room keeps the material that it has chosen, whatever becomes of the file.
TEST_F(FinishEditsTest, MaterialsThatAreGoneStayWithWhoHasThem) {
    room_.edit(kWhiteFloor);
    const auto before = room_.picture();
    std::filesystem::remove(folder_.path() / "white.material");
    materials_.refresh(folder_.path());
    room_.edit({{"rotation", {{"yaw_degrees", 30}}}});
    room_.edit({{"rotation", {{"yaw_degrees", 0}}}});
    EXPECT_EQ(room_.picture(), before);
    refuses({{"material3", {{"material", "white"}}}}, wire::ErrorCode::unknown_name,
            "/finishes/material3/material", "phong");
}

}  // namespace
}  // namespace relume::net
