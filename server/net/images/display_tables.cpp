#include "server/net/images/display_tables.h"

#include <algorithm>
#include <iterator>

namespace relume::net {

std::vector<const DisplayTable*> DisplayTables::of(std::span<const wire::DisplayChoice> choices,
                                                   const wire::Display& room) {
    std::list<std::pair<wire::Display, DisplayTable>> asked_for;
    std::vector<const DisplayTable*> found;
    for (const wire::DisplayChoice& choice : choices) {
        const wire::Display display = wire::display_from_choice(choice, room);
        const auto is_of_display = [&](const auto& entry) { return entry.first == display; };
        auto table = std::find_if(asked_for.begin(), asked_for.end(), is_of_display);
        if (table == asked_for.end()) {
            const auto kept = std::find_if(tables_.begin(), tables_.end(), is_of_display);
            if (kept == tables_.end()) {
                asked_for.emplace_back(display, DisplayTable(display));
            } else {
                asked_for.splice(asked_for.end(), tables_, kept);
            }
            table = std::prev(asked_for.end());
        }
        found.push_back(&table->second);
    }
    tables_ = std::move(asked_for);
    return found;
}

}  // namespace relume::net
