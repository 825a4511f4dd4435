// Who is let into which room.
#include "tests/unit/net/room_fixture.h"

#include <variant>

namespace relume::net {
namespace {

using nlohmann::json;

class RoomsTest : public RoomFixture {};

TEST_F(RoomsTest, BoundsClientsAndRoomsAndNamesTheReason) {
    for (int i = 0; i < 3; ++i) {
        static_cast<void>(enter(ImageInterest::all, "a"));
    }
    EXPECT_EQ(refusal("a"), wire::CloseCode::room_full);
    EXPECT_EQ(refusal("b", std::nullopt), wire::CloseCode::unknown_scene);
    EXPECT_EQ(refusal("b", "none"), wire::CloseCode::unknown_scene);
    EXPECT_EQ(refusal("a", "none"), wire::CloseCode::unknown_scene);
    const Seat b = enter(ImageInterest::all, "b");
    EXPECT_EQ(refusal("c"), wire::CloseCode::too_many_rooms);
    // A room that everybody left makes place.
    rooms_->leave(*b.room, b.viewer);
    EXPECT_NE(enter(ImageInterest::all, "c").room, nullptr);
}

// The rest of a room is for others, who come in while one address holds its part.
TEST_F(RoomsTest, OneAddressMayHoldAPartOfARoom) {
    RoomsOptions narrow = options();
    narrow.room.clients_per_address = 2;
    const auto rooms =
        std::make_shared<Rooms>(scenes_, Libraries{environments_, materials_},
                                RoomThreads{workers_, encoders_}, metrics_, narrow);
    const auto enter_from = [&](const std::string& address) {
        return rooms->enter("r", "tiny",
                            {.role = Role::editor, .outbox = outbox(), .address = address});
    };
    const auto first = enter_from("here");
    ASSERT_TRUE(std::holds_alternative<Rooms::Entered>(first));
    EXPECT_TRUE(std::holds_alternative<Rooms::Entered>(enter_from("here")));
    const auto third = enter_from("here");
    ASSERT_TRUE(std::holds_alternative<Rooms::Refusal>(third));
    EXPECT_EQ(std::get<Rooms::Refusal>(third).code, wire::CloseCode::room_full);
    EXPECT_EQ(std::get<Rooms::Refusal>(third).expected, "at most 2 from one address");
    EXPECT_TRUE(std::holds_alternative<Rooms::Entered>(enter_from("there")));
    // Who leaves gives the place back; the room itself is full without it.
    EXPECT_EQ(std::get<Rooms::Refusal>(enter_from("there")).expected, "at most 3");
    const auto& [room, viewer] = std::get<Rooms::Entered>(first);
    rooms->leave(*room, viewer);
    EXPECT_TRUE(std::holds_alternative<Rooms::Entered>(enter_from("here")));
}

TEST_F(RoomsTest, WhoHasNoRoleIsNotLetIn) {
    const auto entered =
        rooms_->enter("r", "tiny", {.role = Role::none, .outbox = outbox(), .address = "here"});
    ASSERT_TRUE(std::holds_alternative<Rooms::Refusal>(entered));
    EXPECT_EQ(std::get<Rooms::Refusal>(entered).code, wire::CloseCode::bad_token);
}

TEST_F(RoomsTest, StoppedRoomsRefuseEditsAndGuests) {
    const Seat viewer = enter();
    rooms_->stop_edits();
    try {
        viewer.edit(json::object());
        FAIL() << "took an edit while shutting down";
    } catch (const wire::WireError& error) {
        EXPECT_EQ(error.code(), wire::ErrorCode::shutting_down);
    }
    EXPECT_EQ(refusal("r"), wire::CloseCode::shutting_down);
}

}  // namespace
}  // namespace relume::net
