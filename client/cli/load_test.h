// Many connections at once: some drag, the others sit and watch; each in a room of its own.
#pragma once

#include "client/cli/url.h"
#include "protocol/wire/offered_material.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace relume::cli {

struct LoadProgress {
    std::size_t connections = 0;
    std::size_t shown = 0;  // connections that have their first image, or ended
    std::size_t edits = 0;
    std::size_t images = 0;
};

struct LoadOptions {
    Url server;
    std::string scene;
    std::string token;
    std::size_t dragging = 8;
    std::size_t idle = 0;
    double rate_hz = 30;              // edits per second of each dragging connection
    double seconds = 10;              // of dragging
    std::optional<double> budget_ms;  // per image; the server's default without
    std::size_t threads = 1;
    nlohmann::json patch =
        nlohmann::json::object();  // part of each dragging connection's first edit
    // That the server offers. Where parts of the scene may be given some, whoever drags gives
    // them, and moves light and camera as well.
    std::vector<wire::OfferedMaterial> materials = {};
    // Called some times a second, by one thread at a time.
    std::function<void(const LoadProgress&)> on_progress;
};

inline constexpr std::size_t kMaxLoadConnections = 10'000;

// Counts, images per second, and over all dragging connections the spreads of edit-to-image and
// of the errors stated on the images that answered; "errors" counts refusals by code, "ends"
// the connections that did not last, by reason. "ok" when there are none.
[[nodiscard]] nlohmann::json run_load_test(const LoadOptions& options);

}  // namespace relume::cli
