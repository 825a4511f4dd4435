// The tables of the displays that a room's viewers have.
#pragma once

#include "protocol/wire/messages.h"
#include "server/net/images/display_table.h"

#include <list>
#include <span>
#include <utility>
#include <vector>

namespace relume::net {

// Keeps the tables that were asked for last, and makes those that are new. Not thread-safe.
class DisplayTables {
  public:
    // A table for each choice, in order, valid until the next call. What a viewer has not
    // chosen is the room's.
    [[nodiscard]] std::vector<const DisplayTable*> of(
        std::span<const wire::DisplayChoice> choices, const wire::Display& room);

  private:
    std::list<std::pair<wire::Display, DisplayTable>> tables_;
};

}  // namespace relume::net
