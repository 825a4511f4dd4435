#include "tests/unit/net/room_fixture.h"

#include "tests/unit/net/waiting.h"

#include <chrono>
#include <optional>
#include <utility>
#include <variant>

namespace relume::net {

namespace {

light::EnvironmentMap half_bright_map() {
    light::MapImage image{.width = 32, .height = 16, .rgb = {}};
    for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
        const float radiance = i % image.width < 12 ? 2.0F : 0.25F;
        image.rgb.insert(image.rgb.end(), {radiance, radiance / 2, radiance / 4});
    }
    return {std::move(image), light::Projection::lat_long};
}

}  // namespace

void Seat::edit(const nlohmann::json& patch, std::uint64_t id) const {
    room->edit(viewer, {.id = id, .patch = patch}, Clock::now());
}

RoomFixture::RoomFixture() {
    scenes_.refresh(folder_.path());
    environments_.add_upload("map", half_bright_map());
    rooms_ = std::make_shared<Rooms>(scenes_, Libraries{environments_, materials_},
                                     RoomThreads{workers_, encoders_}, metrics_, options());
}

RoomFixture::~RoomFixture() {
    workers_.stop();
    encoders_.stop();
}

RoomsOptions RoomFixture::options() {
    RoomsOptions options;
    options.environment = "map";
    options.room.settle_delay = std::chrono::milliseconds(0);
    options.room.limits.clients_per_room = 3;
    options.room.limits.rooms = 2;
    return options;
}

std::shared_ptr<Outbox> RoomFixture::outbox(ImageInterest interest) {
    return std::make_shared<Outbox>(interest, wire::Limits());
}

Seat RoomFixture::enter(Rooms& rooms, ImageInterest interest, const std::string& room) {
    std::shared_ptr<Outbox> box = outbox(interest);
    const auto entered = std::get<Rooms::Entered>(
        rooms.enter(room, "tiny", {.role = Role::editor, .outbox = box, .address = "here"}));
    return {.room = entered.room, .viewer = entered.viewer, .outbox = std::move(box)};
}

Seat RoomFixture::enter(ImageInterest interest, const std::string& room) const {
    return enter(*rooms_, interest, room);
}

wire::CloseCode RoomFixture::refusal(const std::string& room,
                                     const std::optional<std::string>& scene,
                                     const std::string& address) const {
    return std::get<Rooms::Refusal>(
               rooms_->enter(room, scene,
                             {.role = Role::editor, .outbox = outbox(), .address = address}))
        .code;
}

SharedImageFrame RoomFixture::settled_image(const Seat& seat,
                                            std::uint64_t revision,
                                            std::vector<nlohmann::json>* texts) {
    SharedImageFrame found;
    EXPECT_TRUE(eventually([&] {
        std::optional<Outbox::Item> item = seat.outbox->take();
        if (!item) {
            return false;
        }
        if (const auto* const text = std::get_if<std::string>(&*item)) {
            if (texts != nullptr) {
                texts->push_back(nlohmann::json::parse(*text));
            }
            return false;
        }
        const auto frame = std::get<SharedImageFrame>(*item);
        seat.room->acknowledge(seat.viewer, frame->header.sequence);
        if (frame->settled && frame->header.revision == revision) {
            found = frame;
        }
        return found != nullptr;
    }));
    return found;
}

std::vector<std::byte> payload_of(const SharedImageFrame& frame) {
    return {frame->bytes.begin() + wire::kImageHeaderBytes, frame->bytes.end()};
}

}  // namespace relume::net
