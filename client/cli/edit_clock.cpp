#include "client/cli/edit_clock.h"

#include <algorithm>

namespace relume::cli {

void EditClock::edit_sent(std::uint64_t id, Clock::time_point when) {
    pending_.push_back({.id = id, .sent = when, .revision = 0});
}

void EditClock::edit_refused(std::uint64_t id) {
    std::erase_if(pending_, [id](const Pending& edit) { return edit.id == id; });
}

void EditClock::change_received(std::uint64_t edit_id, std::uint64_t revision) {
    for (Pending& edit : pending_) {
        if (edit.id <= edit_id && edit.revision == 0) {
            edit.revision = revision;
        }
    }
}

std::vector<double> EditClock::image_received(std::uint64_t revision, Clock::time_point when) {
    std::vector<double> milliseconds;
    std::erase_if(pending_, [&](const Pending& edit) {
        const bool shown = edit.revision != 0 && edit.revision <= revision;
        if (shown) {
            milliseconds.push_back(
                std::chrono::duration<double, std::milli>(when - edit.sent).count());
        }
        return shown;
    });
    return milliseconds;
}

}  // namespace relume::cli
