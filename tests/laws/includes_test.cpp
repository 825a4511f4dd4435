// Which part of the project may include which: no upward or sideways includes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace relume {
namespace {

namespace fs = std::filesystem;

// Folder → folders it may include from, itself not named; all but protocol/base/
// may include from protocol/base/. The longest matching folder counts.
const std::map<std::string, std::set<std::string>>& allowed_includes() {
    static const std::map<std::string, std::set<std::string>> allowed{
        {"protocol/base/files", {"protocol/base/text"}},
        {"protocol/base/geometry", {}},
        {"protocol/base/text", {}},
        {"protocol/base/timing", {}},
        {"protocol/base/program", {"protocol/base/files", "protocol/base/text"}},
        {"protocol/basis", {}},
        {"protocol/brdf", {"protocol/basis"}},
        {"protocol/curve", {"protocol/brdf"}},
        {"protocol/light", {"protocol/basis"}},
        {"protocol/transport", {"protocol/basis", "protocol/brdf", "protocol/curve"}},
        {"protocol/tripling", {"protocol/basis"}},
        {"protocol/relighting", {}},
        {"protocol/sampling",
         {"protocol/basis", "protocol/brdf", "protocol/curve", "protocol/light",
          "protocol/transport"}},
        {"protocol/wire", {"protocol/curve", "protocol/relighting"}},
        {"precompute/scene", {"protocol/basis", "protocol/brdf"}},
        {"precompute/factors", {"precompute/scene", "protocol/brdf", "protocol/curve"}},
        {"precompute/materials",
         {"precompute/factors", "precompute/scene", "protocol/basis", "protocol/brdf",
          "protocol/tripling"}},
        {"precompute/bake/base",
         {"precompute/factors", "precompute/scene", "protocol/basis", "protocol/transport"}},
        {"precompute/bake/rays",
         {"precompute/bake/base", "precompute/scene", "protocol/basis", "protocol/transport"}},
        {"precompute/bake/receivers",
         {"precompute/bake/rays", "precompute/scene", "protocol/brdf", "protocol/transport"}},
        {"precompute/bake/receivers/pixel",
         {"precompute/bake/base", "precompute/bake/rays", "precompute/bake/receivers",
          "precompute/scene", "protocol/brdf", "protocol/transport", "protocol/sampling"}},
        {"precompute/bake/receivers/vertex",
         {"precompute/bake/base", "precompute/bake/rays", "precompute/bake/receivers",
          "precompute/scene", "protocol/brdf", "protocol/transport"}},
        {"precompute/bake/rows",
         {"precompute/bake/base", "precompute/bake/rays", "precompute/bake/receivers",
          "precompute/scene", "protocol/basis", "protocol/brdf", "protocol/transport",
          "protocol/sampling"}},
        {"precompute/bake/blocks",
         {"precompute/bake/base", "precompute/bake/rays", "precompute/bake/receivers",
          "precompute/bake/rows", "precompute/scene", "protocol/basis", "protocol/brdf",
          "protocol/transport"}},
        {"precompute/bake/probes",
         {"precompute/bake/blocks", "precompute/bake/rays", "precompute/bake/receivers/vertex",
          "precompute/bake/rows", "precompute/scene", "protocol/basis", "protocol/brdf",
          "protocol/transport"}},
        {"precompute/bake/curves",
         {"precompute/bake/base", "precompute/bake/blocks", "precompute/bake/rays",
          "precompute/bake/receivers", "precompute/bake/receivers/pixel",
          "precompute/bake/rows", "precompute/factors", "precompute/scene", "protocol/basis",
          "protocol/brdf", "protocol/curve", "protocol/light", "protocol/sampling",
          "protocol/transport", "protocol/wire"}},
        {"precompute/bake/fields",
         {"precompute/bake/base", "precompute/bake/curves", "precompute/bake/rays",
          "precompute/bake/receivers", "precompute/bake/rows", "precompute/scene",
          "protocol/basis", "protocol/brdf", "protocol/curve", "protocol/transport"}},
        {"precompute/bake",
         {"precompute/bake/base", "precompute/bake/blocks", "precompute/bake/curves",
          "precompute/bake/fields", "precompute/bake/probes", "precompute/bake/rays",
          "precompute/bake/receivers", "precompute/bake/receivers/pixel",
          "precompute/bake/receivers/vertex", "precompute/bake/rows", "precompute/factors",
          "precompute/materials", "precompute/scene", "protocol/basis", "protocol/brdf",
          "protocol/curve", "protocol/light", "protocol/transport", "protocol/tripling"}},
        {"server/decoder", {"protocol/light"}},
        {"server/engine/kernels",
         {"protocol/basis", "protocol/transport", "protocol/tripling"}},
        {"server/engine/columns",
         {"protocol/basis", "protocol/relighting", "protocol/transport",
          "server/engine/kernels"}},
        {"server/engine/choosing",
         {"protocol/basis", "protocol/relighting", "protocol/transport",
          "server/engine/columns", "server/engine/kernels"}},
        {"server/engine/operators",
         {"protocol/transport", "server/engine/columns", "server/engine/kernels"}},
        {"server/engine/sums",
         {"protocol/transport", "server/engine/columns", "server/engine/kernels",
          "server/engine/operators"}},
        {"server/engine",
         {"protocol/relighting", "server/engine/choosing", "server/engine/columns",
          "server/engine/operators", "server/engine/sums"}},
        {"server/view",
         {"protocol/basis", "protocol/brdf", "protocol/transport", "server/engine/kernels"}},
        {"server/triple",
         {"protocol/basis", "protocol/light", "protocol/transport", "protocol/tripling",
          "server/engine/kernels", "server/view"}},
        {"server/materials",
         {"protocol/basis", "protocol/brdf", "protocol/curve", "protocol/light",
          "protocol/sampling", "protocol/transport", "server/view"}},
        {"server/scene",
         {"protocol/basis", "protocol/transport", "server/engine", "server/engine/operators",
          "server/materials", "server/triple", "server/view"}},
        {"server/net/base", {"protocol/wire", "server/engine"}},
        {"server/net/peers", {"server/net/base"}},
        {"server/net/images",
         {"protocol/transport", "protocol/wire", "server/engine/kernels", "protocol/light",
          "server/net/base", "server/view"}},
        {"server/net/library",
         {"protocol/basis", "protocol/curve", "protocol/transport", "protocol/tripling",
          "protocol/wire", "protocol/light", "server/net/base", "server/net/images",
          "server/scene", "server/triple"}},
        {"server/net/http",
         {"protocol/transport", "protocol/wire", "protocol/light", "server/decoder",
          "server/net/base", "server/net/images", "server/net/library", "server/net/peers"}},
        {"server/net/rooms",
         {"protocol/basis", "protocol/curve", "protocol/light", "protocol/relighting",
          "protocol/transport", "protocol/wire", "server/engine", "server/net/base",
          "server/net/images", "server/net/library", "server/net/peers", "server/materials",
          "server/scene", "server/triple", "server/view"}},
        {"server/net/sockets",
         {"protocol/wire", "server/net/base", "server/net/http", "server/net/images",
          "server/net/peers", "server/net/rooms"}},
        {"server/net",
         {"protocol/wire", "server/engine/sums", "protocol/light", "server/net/base",
          "server/net/http", "server/net/library", "server/net/peers", "server/net/rooms",
          "server/net/sockets"}},
        {"client/cli", {"protocol/curve", "protocol/relighting", "protocol/wire"}},
    };
    return allowed;
}

std::string part_of(const std::string& path) {
    std::string best;
    for (const auto& [folder, allowed] : allowed_includes()) {
        if (path.rfind(folder + "/", 0) == 0 && folder.size() > best.size())
            best = folder;
    }
    return best;
}

std::vector<fs::path> sources_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".h" || extension == ".cpp")
            files.push_back(entry.path());
    }
    return files;
}

// Includes of one file that its folder does not allow.
std::vector<std::string> forbidden_includes(const std::string& own_path, std::istream& source) {
    static const std::regex kInclude(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
    static const std::regex kOurs(R"(^(protocol|precompute|server|client|tests)/.*)");
    const std::string part = part_of(own_path);
    const std::set<std::string>& allowed = allowed_includes().at(part);
    std::vector<std::string> forbidden;
    std::string line;
    while (std::getline(source, line)) {
        std::smatch match;
        if (!std::regex_search(line, match, kInclude))
            continue;
        const std::string included = match[1];
        if (!std::regex_match(included, kOurs))
            continue;
        const std::string other = part_of(included);
        const bool is_base =
            other.rfind("protocol/base/", 0) == 0 && part.rfind("protocol/base/", 0) != 0;
        if (other != part && !is_base && allowed.count(other) == 0)
            forbidden.push_back(included);
    }
    return forbidden;
}

TEST(Includes, GoDownwardsOnly) {
    const fs::path root = RELUME_SOURCE_DIR;
    std::size_t files = 0;
    for (const auto& [folder, allowed] : allowed_includes()) {
        for (const fs::path& file : sources_below(root / folder)) {
            std::ifstream stream(file);
            const std::string own = fs::relative(file, root).generic_string();
            for (const std::string& included : forbidden_includes(own, stream))
                ADD_FAILURE() << own << " includes " << included;
            ++files;
        }
    }
    EXPECT_GT(files, 50U);
}

// Every folder with sources has a rule, so that a new one cannot slip by.
TEST(Includes, EveryFolderHasARule) {
    const fs::path root = RELUME_SOURCE_DIR;
    for (const char* top : {"protocol", "precompute", "server", "client"}) {
        for (const fs::path& file : sources_below(root / top)) {
            const std::string own = fs::relative(file, root).generic_string();
            if (own.find("node_modules") == std::string::npos) {
                EXPECT_FALSE(part_of(own).empty()) << own;
            }
        }
    }
}

TEST(Includes, ForbiddenOnesAreSeen) {
    const auto forbidden = [](const std::string& path, const std::string& text) {
        std::istringstream source(text);
        return forbidden_includes(path, source);
    };
    EXPECT_EQ(forbidden("precompute/bake/a.cpp", "#include \"server/engine/b.h\"\n").size(),
              1U);
    EXPECT_EQ(
        forbidden("precompute/bake/rows/a.h", "#include \"precompute/bake/b.h\"\n").size(), 1U);
    EXPECT_EQ(forbidden("precompute/bake/blocks/a.h",
                        "#include \"precompute/bake/receivers/pixel/b.h\"\n")
                  .size(),
              1U);
    EXPECT_EQ(forbidden("server/engine/a.h", "  #  include <server/net/b.h>\n").size(), 1U);
    EXPECT_EQ(forbidden("protocol/basis/a.h", "#include \"protocol/transport/b.h\"\n").size(),
              1U);
    EXPECT_EQ(forbidden("server/net/a.h", "#include \"tests/support/b.h\"\n").size(), 1U);
    EXPECT_TRUE(
        forbidden("server/net/rooms/a.h", "#include \"server/net/base/b.h\"\n").empty());
    EXPECT_TRUE(forbidden("server/net/a.h", "#include <vector>\n").empty());
}

}  // namespace
}  // namespace relume
