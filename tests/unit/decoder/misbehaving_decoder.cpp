// Stands in for relume-decode and does what its input says, as a decoder might that was taken
// over.
#include "protocol/light/projection.h"
#include "server/decoder/decoder_reply.h"
#include "server/decoder/sandbox.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

using relume::decoder::ReplyHeader;
using relume::decoder::ReplyStatus;

std::string input() {
    std::string text;
    char buffer[256];
    for (ssize_t count = 0; (count = read(STDIN_FILENO, buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<std::size_t>(count));
    }
    return text;
}

void put(const void* data, std::size_t size) {
    if (write(STDOUT_FILENO, data, size) != static_cast<ssize_t>(size)) {
        _exit(40);
    }
}

void answer(ReplyHeader header, float value, std::size_t count) {
    put(&header, sizeof header);
    for (std::size_t i = 0; i < count; ++i) {
        put(&value, sizeof value);
    }
}

[[noreturn]] void spin() {
    for (std::atomic<unsigned> i = 0;; ++i) {
    }
}

// Status 0 if this process inherited nothing but its three standard descriptors.
void check_inheritance(char** environment) {
    for (int fd = 3; fd < 1024; ++fd) {
        if (fcntl(fd, F_GETFD) != -1) {
            _exit(50);
        }
    }
    if (environment[0] != nullptr) {
        _exit(51);
    }
    sigset_t blocked;
    sigprocmask(SIG_SETMASK, nullptr, &blocked);
    if (sigismember(&blocked, SIGTERM) != 0) {
        _exit(52);
    }
    const char byte = 0;
    if (write(STDIN_FILENO, &byte, 1) != -1 || ftruncate(STDIN_FILENO, 0) != -1) {
        _exit(53);
    }
    answer({.status = ReplyStatus::decoded, .width = 2, .height = 1}, 1.0F, 6);
}

constexpr int kGotAway = 60;

int try_to(const std::string& act) {
    if (act == "open") {
        (void)open("/etc/hostname", O_RDONLY | O_CLOEXEC);
    } else if (act == "socket") {
        (void)socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    } else if (act == "fork") {
        (void)fork();
    } else if (act == "exec") {
        execl("/bin/true", "true", nullptr);
    } else if (act == "kill") {
        (void)kill(getppid(), 0);
    } else if (act == "make executable memory") {
        (void)mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    }
    return kGotAway;
}

}  // namespace

int main(int /*argc*/, char** /*argv*/, char** environment) {
    const std::string mode = input();
    if (mode == "crash") {
        std::signal(SIGSEGV, SIG_DFL);
        std::raise(SIGSEGV);
    } else if (mode == "hang") {
        for (;;) {
            pause();
        }
    } else if (mode == "spin") {
        spin();
    } else if (mode == "silent") {
        return 0;
    } else if (mode == "fail") {
        return 3;
    } else if (mode == "nonsense") {
        put("this is not an answer at all", 28);
    } else if (mode == "endless text") {
        answer({.text_bytes = 0xffffffff}, 0, 0);
    } else if (mode == "huge image") {
        answer({.status = ReplyStatus::decoded, .width = 16384, .height = 16384}, 0, 0);
    } else if (mode == "short image") {
        answer({.status = ReplyStatus::decoded, .width = 2, .height = 1}, 1.0F, 5);
    } else if (mode == "wrong shape") {
        const auto square = static_cast<std::uint32_t>(relume::light::Projection::angular_map);
        answer({.status = ReplyStatus::decoded, .width = 3, .height = 1, .projection = square},
               1, 9);
    } else if (mode == "unknown projection") {
        answer({.status = ReplyStatus::decoded, .width = 2, .height = 1, .projection = 99}, 1,
               6);
    } else if (mode == "bad values") {
        answer({.status = ReplyStatus::decoded, .width = 2, .height = 1}, -1.0F, 6);
    } else if (mode == "control characters") {
        const std::string text = "\x1b[31mred\n\n\n";
        const ReplyHeader header{.text_bytes = static_cast<std::uint32_t>(text.size())};
        put(&header, sizeof header);
        put(text.data(), text.size());
    } else if (mode == "inheritance") {
        check_inheritance(environment);
    } else if (mode.starts_with("try to ")) {
        relume::decoder::run_sandboxed(
            {.address_space_bytes = std::size_t{1} << 33, .cpu_seconds = 5},
            [&] { return try_to(mode.substr(std::strlen("try to "))); });
    }
    return 0;
}
