// describe_state: holds what is written out of the descriptions of the room's state against
// them, or writes it.
#include "protocol/base/files/atomic_file.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/program.h"
#include "protocol/wire/describe/contract_table.h"
#include "protocol/wire/describe/page_types.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace {

using relume::program::kDone;
using relume::program::kFailed;

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr std::string_view kBegin = "<!-- describe_state writes from here -->\n";
constexpr std::string_view kEnd = "<!-- to here -->\n";

std::string with_table(std::string page, const std::filesystem::path& path) {
    const std::size_t begin = page.find(kBegin);
    const std::size_t end = page.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin) {
        throw std::runtime_error(fmt::format(
            "{}: has no lines {}and {}around the table of §3.1", path.string(), kBegin, kEnd));
    }
    const std::size_t table = begin + kBegin.size();
    return page.replace(table, end - table, relume::wire::contract_table());
}

// False where the file is not as it should be, and is left so.
bool settle(const std::filesystem::path& path,
            const std::string& found,
            const std::string& expected,
            bool may_write) {
    if (found == expected) {
        return true;
    }
    if (may_write) {
        relume::files::write_file_atomically(path, {relume::files::bytes_of(expected)});
        fmt::print("{}: written\n", path.string());
        return true;
    }
    const auto differs =
        std::mismatch(found.begin(), found.end(), expected.begin(), expected.end()).first;
    fmt::print(stderr,
               "{}:{}: is not what protocol/wire/sections describes; describe_state --write "
               "writes it\n",
               path.string(), 1 + std::count(found.begin(), differs, '\n'));
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Holds the contract's table and the page's types against protocol/wire/sections.",
        "describe_state");
    std::filesystem::path root;
    bool may_write = false;
    app.add_option("ROOT", root, "The repository")->required()->check(CLI::ExistingDirectory);
    app.add_flag("--write", may_write, "Write them where they differ");
    return relume::program::run_program(app, argc, argv, [&] {
        const auto page = root / "protocol/README.md";
        const auto types = root / "client/web/src/wire/state.ts";
        const auto read = [](const std::filesystem::path& path) {
            return relume::files::read_regular_file(path, kMostBytes);
        };
        const std::string contract = read(page);
        const bool is_page = settle(page, contract, with_table(contract, page), may_write);
        const bool are_types =
            settle(types, read(types), relume::wire::page_types(), may_write);
        return is_page && are_types ? kDone : kFailed;
    });
}
