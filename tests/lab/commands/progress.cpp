#include "tests/lab/commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace relume::lab {

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (terminal_ && drawn_) {
        fmt::print(stderr, "\n");
    }
}

void Progress::update(std::size_t done, const std::string& note) {
    const auto now = Clock::now();
    if (now < next_ && done != total_) {
        return;
    }
    next_ = now + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double left =
        done == 0 ? 0
                  : seconds * static_cast<double>(total_ - done) / static_cast<double>(done);
    const std::string text = fmt::format("{}{}{} {} of {}, {:.0f} s left", note,
                                         note.empty() ? "" : ": ", what_, done, total_, left);
    if (terminal_) {
        fmt::print(stderr, "\r{}\x1b[K", text);
    } else {
        fmt::print(stderr, "{}\n", text);
    }
    drawn_ = true;
}

}  // namespace relume::lab
