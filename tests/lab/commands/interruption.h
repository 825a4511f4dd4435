// SIGINT as a request to finish what is at hand and write it down.
#pragma once

namespace relume::lab {

// Exit code of a program that was interrupted and says so.
inline constexpr int kInterrupted = 130;

// From here on SIGINT does not end the program; a second one does.
void catch_interruption();
[[nodiscard]] bool is_interrupted();

}  // namespace relume::lab
