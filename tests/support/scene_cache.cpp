#include "tests/support/scene_cache.h"

#include "protocol/transport/error.h"
#include "tests/support/program.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace relume::test {

namespace fs = std::filesystem;

std::shared_ptr<const served::Scene> open_if_whole(const fs::path& directory) {
    try {
        return std::make_shared<const served::Scene>(transport::Transport::open(directory));
    } catch (const transport::TransportError&) {
        return nullptr;
    }
}

SceneCache::SceneCache(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directories(folder_);
}

std::shared_ptr<const served::Scene> SceneCache::baked(
    const std::string& name, const std::vector<std::string>& arguments) {
    const fs::path directory = folder_ / (name + ".relume");
    if (auto scene = open_if_whole(directory)) {
        return scene;
    }
    fmt::print(stderr, "baking {} (once)\n", directory.string());
    std::vector<std::string> words = arguments;
    words.insert(words.end(), {"-o", directory.string()});
    run_to_end(RELUME_BAKE, words, folder_, name);
    return std::make_shared<const served::Scene>(transport::Transport::open(directory));
}

}  // namespace relume::test
