// The page's types of the room's state: client/web/src/wire/state.ts.
#pragma once

#include <string>

namespace relume::wire {

// The whole file.
[[nodiscard]] std::string page_types();

}  // namespace relume::wire
