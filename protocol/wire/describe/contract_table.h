// The table of protocol/README.md §3.1.
#pragma once

#include <string>

namespace relume::wire {

// Markdown, a row a section and a row a field.
[[nodiscard]] std::string contract_table();

}  // namespace relume::wire
