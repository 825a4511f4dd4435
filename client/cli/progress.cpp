#include "client/cli/progress.h"

#include <unistd.h>

#include <cstdio>

namespace relume::cli {

Progress::Progress(bool always) : terminal_(::isatty(STDERR_FILENO) == 1), always_(always) {}

Progress::~Progress() {
    if (terminal_ && drawn_) {
        std::fputc('\n', stderr);
    }
}

void Progress::update(const std::string& text) {
    const auto now = Clock::now();
    if (is_silent() || now < next_) {
        return;
    }
    next_ = now + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(2));
    std::fprintf(stderr, terminal_ ? "\r%s\x1b[K" : "%s\n", text.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

}  // namespace relume::cli
