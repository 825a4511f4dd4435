// Whatever a client sends is a message or a WireError; a patch is applied whole, keeps the
// state within its ranges and normal form, or leaves it alone.
#include "protocol/wire/messages.h"
#include "protocol/wire/room_patch.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

namespace wire = relume::wire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

void check_edit(const wire::Edit& edit) {
    const wire::Limits limits;
    const wire::RoomState before;
    wire::RoomState state;
    wire::AppliedPatch applied;
    try {
        applied = wire::apply_patch(state, edit.patch, limits);
    } catch (const wire::WireError& error) {
        require(state == before);
        require(!error.found().empty() && !error.expected().empty());
        static_cast<void>(wire::text_from_message(wire::message_from_error(error)));
        return;
    }
    nlohmann::json merged = wire::to_json(before);
    merged.merge_patch(applied.patch);
    require(merged == wire::to_json(state));
    require(wire::room_state_from_json(nlohmann::json::parse(merged.dump())) == state);
    require(wire::apply_patch(state, applied.patch, limits).patch == applied.patch);
    require(wire::apply_patch(state, applied.inverse, limits).patch == applied.inverse);
    require(state == before);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const wire::ClientMessage message = wire::parse_client_message(text, wire::Limits{});
        if (const auto* edit = std::get_if<wire::Edit>(&message)) {
            check_edit(*edit);
        }
    } catch (const wire::WireError& error) {
        require(!error.found().empty() && !error.expected().empty());
    }
    try {
        static_cast<void>(wire::parse_server_message(text));
    } catch (const wire::WireError& error) {
        require(!error.found().empty() && !error.expected().empty());
    }
    return 0;
}
