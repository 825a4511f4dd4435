#include "tests/bench/programs.h"

#include "tests/load/program.h"

#include <fmt/format.h>

#include <stdexcept>

namespace relume::bench {

std::filesystem::path bake_program() {
    return RELUME_BAKE;
}
std::filesystem::path server_program() {
    return RELUME_SERVER;
}
std::filesystem::path client_program() {
    return RELUME_CLIENT;
}

std::string run_to_end(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder,
                       const std::string& name) {
    test::Program process(program, arguments, folder, name);
    const int code = process.wait();
    if (code != 0) {
        throw std::runtime_error(
            fmt::format("{} ended with {}: {}", program.string(), code, process.errors()));
    }
    return process.output();
}

}  // namespace relume::bench
