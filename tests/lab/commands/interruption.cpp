#include "tests/lab/commands/interruption.h"

#include <atomic>
#include <csignal>

namespace relume::lab {
namespace {

std::atomic<bool> interrupted = false;

void interrupt(int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interruption() {
    std::signal(SIGINT, interrupt);
}

bool is_interrupted() {
    return interrupted;
}

}  // namespace relume::lab
