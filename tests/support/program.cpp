#include "tests/support/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

extern "C" char** environ;

namespace relume::test {
namespace {

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

int exit_code_from_status(int status) {
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

Program::Program(const std::filesystem::path& program,
                 const std::vector<std::string>& arguments,
                 const std::filesystem::path& folder,
                 const std::string& name)
    : output_(folder / (name + ".out")), errors_(folder / (name + ".err")) {
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);

    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, output_.c_str(), kWrite, 0600);
    posix_spawn_file_actions_addopen(&files, 2, errors_.c_str(), kWrite, 0600);
    const int error =
        posix_spawn(&process_, program.c_str(), &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) {
        process_ = -1;
        throw std::system_error(error, std::generic_category(), program.string());
    }
}

Program::~Program() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
}

void Program::send(int signal) const {
    ::kill(process_, signal);
}

int Program::wait() {
    if (process_ > 0) {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        exit_code_ = exit_code_from_status(status);
    }
    return exit_code_;
}

bool Program::is_running() {
    if (process_ <= 0) {
        return false;
    }
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) {
        process_ = -1;
        exit_code_ = exit_code_from_status(status);
        return false;
    }
    return true;
}

std::string Program::output() const {
    return content_of(output_);
}
std::string Program::errors() const {
    return content_of(errors_);
}

std::string run_to_end(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder,
                       const std::string& name) {
    Program process(program, arguments, folder, name);
    const int code = process.wait();
    if (code != 0) {
        throw std::runtime_error(
            fmt::format("{} ended with {}: {}", program.string(), code, process.errors()));
    }
    return process.output();
}

}  // namespace relume::test
