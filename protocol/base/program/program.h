// How every program begins and ends, so that all end alike.
#pragma once

#include "protocol/base/program/usage.h"

#include <functional>

namespace relume::program {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;

// Parses the words, then does the work and returns its exit code; callbacks of `app` are part
// of the work. --help and --version give kDone. A mistake in the words, or UsageError, is told
// on standard error in one line that begins with the program's name, and gives kWrongUsage; any
// other exception likewise gives kFailed, and so does standard output that could not be
// written. Writing beyond the limit on file sizes is an error of the write meanwhile.
[[nodiscard]] int run_program(CLI::App& app,
                              int argc,
                              const char* const* argv,
                              const std::function<int()>& work);

}  // namespace relume::program
