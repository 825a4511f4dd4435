// A room in which light and materials are edited: exact at rest, whatever the way there was.
#include "protocol/wire/room_patch.h"
#include "server/net/rooms/curve_edits.h"
#include "server/net/rooms/relighter.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_materials.h"
#include "tests/support/tiny_transport.h"
#include "tests/unit/net/exact_picture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

// A room of one scene, and what it shows.
class Room {
  public:
    Room(std::shared_ptr<const ServedScene> scene, Metrics& metrics)
        : scene_(std::move(scene)), relighter_(scene_, metrics, std::chrono::milliseconds(20)) {
        state_.background.mode = wire::BackgroundMode::transparent;
        show(kAllStages);
    }

    void edit(json patch) {
        patch = with_samples(patch, state_.materials, scene_->loaded->curves());
        wire::apply_patch(state_, patch, {});
        show(wire::stages_of(patch));
    }
    void turn_on_a_lamp(double x) {
        edit({{"lights",
               {{"key",
                 {{"direction", {x, 1, 0.2}},
                  {"angular_radius_degrees", 25},
                  {"radiance", {9, 8, 7}}}}}}});
    }
    void advance() {
        Relighter* const self = &relighter_;
        Relighter::advance_together({&self, 1});
    }
    void rest() {
        while (!relighter_.at_rest()) {
            advance();
        }
    }
    std::vector<std::uint16_t> picture_at_rest() {
        rest();
        EXPECT_EQ(relighter_.stated_error(), 0);
        return exact_picture(relighter_);
    }
    Relighter& relighter() { return relighter_; }

  private:
    void show(wire::Stages stages) {
        EXPECT_TRUE(relighter_.set_state(state_, {}, {}, stages).empty());
    }

    std::shared_ptr<const ServedScene> scene_;
    Relighter relighter_;
    wire::RoomState state_;
};

class EditedMaterialsTest : public testing::Test {
  protected:
    EditedMaterialsTest() {
        test::write_tiny_transport(folder_.path() / "plain.relume");
        test::write_tiny_transport(folder_.path() / "tiny.relume");
        test::add_random_materials(folder_.path() / "tiny.relume");
        scenes_.refresh(folder_.path());
    }
    Room room(const char* scene = "tiny") { return {scenes_.find(scene), metrics_}; }

    test::ScratchDirectory folder_;
    SceneLibrary scenes_;
    Metrics metrics_;
};

const json kGold{{"metal.fresnel", {{"shape", "schlick"}, {"f0", {1, 0.6, 0.1}}}}};
const json kRough{{"metal.distribution", {{"roughness", 0.8}}}};
const json kRed{{"cloth.distribution", {{"diffuse", {2, 0.1, 0.1}}}}};

TEST_F(EditedMaterialsTest, AMaterialThatNobodyEditsHasTheBitsOfASceneWithout) {
    Room with = room();
    Room without = room("plain");
    with.turn_on_a_lamp(0.3);
    without.turn_on_a_lamp(0.3);
    EXPECT_EQ(with.picture_at_rest(), without.picture_at_rest());
}

TEST_F(EditedMaterialsTest, AnEditTakenBackGivesTheBitsFromBefore) {
    Room room = this->room();
    room.turn_on_a_lamp(0.3);
    const auto before = room.picture_at_rest();
    room.edit({{"materials", kGold}});
    const auto gold = room.picture_at_rest();
    EXPECT_NE(gold, before);
    room.edit({{"materials", kRed}});
    EXPECT_NE(room.picture_at_rest(), gold);
    room.edit({{"materials", {{"metal.fresnel", nullptr}, {"cloth.distribution", nullptr}}}});
    EXPECT_EQ(room.picture_at_rest(), before);
}

TEST_F(EditedMaterialsTest, LightAndMaterialsComeToTheSameInEitherOrder) {
    Room light_first = room();
    light_first.turn_on_a_lamp(0.3);
    light_first.edit({{"materials", kRough}});
    Room material_first = room();
    material_first.edit({{"materials", kRough}});
    material_first.advance();
    material_first.turn_on_a_lamp(-0.9);
    material_first.advance();
    material_first.turn_on_a_lamp(0.3);
    EXPECT_EQ(material_first.picture_at_rest(), light_first.picture_at_rest());
}

// What columns are made of does not depend on which curve was edited first; only which of them
// is taken up does, and that the room's edits say.
TEST_F(EditedMaterialsTest, CurvesOfOneMaterialAndOfOthersAddUp) {
    Room one_by_one = room();
    one_by_one.turn_on_a_lamp(0.3);
    one_by_one.edit({{"materials", kRed}});
    one_by_one.rest();
    one_by_one.edit({{"materials", kGold}});
    one_by_one.rest();
    one_by_one.edit({{"materials", kRough}});
    Room at_once = room();
    at_once.turn_on_a_lamp(0.3);
    json all = kRed;
    all.update(kGold);
    at_once.edit({{"materials", all}});
    at_once.edit({{"materials", kRough}});
    EXPECT_EQ(one_by_one.picture_at_rest(), at_once.picture_at_rest());
}

TEST_F(EditedMaterialsTest, SaysThatAnEditIsNotExactYet) {
    Room room = this->room();
    room.turn_on_a_lamp(0.3);
    room.rest();
    room.edit({{"materials", kRough}});
    EXPECT_FALSE(room.relighter().at_rest());
    EXPECT_GT(room.relighter().stated_error(), 0);
    room.rest();
    EXPECT_EQ(room.relighter().stated_error(), 0);
}

}  // namespace
}  // namespace relume::net
