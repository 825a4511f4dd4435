// Rooms of one small scene in this process, and people in them, without sockets.
#pragma once

#include "server/net/library/environment_library.h"
#include "server/net/rooms/rooms.h"
#include "tests/unit/net/tiny_scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace relume::net {

// One who has come into a room.
struct Seat {
    std::shared_ptr<Room> room;
    ViewerId viewer{};
    std::shared_ptr<Outbox> outbox;

    void edit(const nlohmann::json& patch, std::uint64_t id = 1) const;
};

// Three places in a room and two rooms, lit by "map"; a state settles at once.
class RoomFixture : public testing::Test {
  protected:
    RoomFixture();
    ~RoomFixture() override;

    [[nodiscard]] static RoomsOptions options();
    [[nodiscard]] static std::shared_ptr<Outbox> outbox(
        ImageInterest interest = ImageInterest::all);
    // Into the rooms, or others than this fixture's.
    [[nodiscard]] Seat enter(ImageInterest interest = ImageInterest::all,
                             const std::string& room = "r") const;
    [[nodiscard]] static Seat enter(Rooms& rooms,
                                    ImageInterest interest,
                                    const std::string& room);
    // The code of a refusal, from this address.
    [[nodiscard]] wire::CloseCode refusal(const std::string& room,
                                          const std::optional<std::string>& scene = "tiny",
                                          const std::string& address = "here") const;
    // Takes, and acknowledges, until a settled image of the revision comes: null, and a
    // failure, if none does. The text goes to `texts`.
    static SharedImageFrame settled_image(const Seat& seat,
                                          std::uint64_t revision,
                                          std::vector<nlohmann::json>* texts = nullptr);

    TinyScenes folder_;
    Metrics metrics_;
    SceneLibrary scenes_;
    EnvironmentLibrary environments_{EnvironmentBounds{}};
    MaterialLibrary materials_{0};
    WorkerPool workers_{2, {.edits = 1, .refinements = 16}};
    WorkerPool encoders_{2, {}};
    std::shared_ptr<Rooms> rooms_;
};

// Of an image, without its header.
[[nodiscard]] std::vector<std::byte> payload_of(const SharedImageFrame& frame);

}  // namespace relume::net
