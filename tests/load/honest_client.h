// Who works on a scene while others attack the server: what it gets is what the attack costs.
#pragma once

#include <cstdint>
#include <filesystem>

namespace relume::test {

struct Work {
    double edits = 0;
    double edits_shown = 0;
    double images = 0;
    double edit_to_image_ms_p99 = 0;
};

// Drags two rooms of the scene "work" for two seconds with the program `relume load`. Throws
// std::runtime_error when a session was refused or ended early.
[[nodiscard]] Work work_for_a_while(std::uint16_t port, const std::filesystem::path& folder);

}  // namespace relume::test
