// One image of one state: join a room, edit it or not, wait until the image is good enough.
#pragma once

#include "client/cli/room_connection.h"
#include "protocol/wire/half_image.h"
#include "protocol/wire/messages.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <optional>
#include <vector>

namespace relume::cli {

struct SettledImageRequest {
    ConnectionOptions connection;
    nlohmann::json patch = nlohmann::json::object();  // empty leaves the room as it is
    // Accept a settled image at or below this stated error; otherwise only an exact one. The
    // room settles there only if its budget's target_error says so.
    std::optional<double> until_error;
    std::chrono::milliseconds timeout{120'000};
};

struct SettledImage {
    wire::ImageHeader header;
    wire::HalfImage image;
    wire::SceneSummary scene;
    wire::RoomState state;                   // what the image shows, and how to display it
    std::optional<double> edit_to_image_ms;  // until the settled image; none without an edit
};

// Throws ClientError when the server refuses, ends the connection, or does not get there in
// time.
[[nodiscard]] SettledImage fetch_settled_image(const SettledImageRequest& request);

}  // namespace relume::cli
