#include "tests/stability/workbench.h"

#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"

#include <fmt/format.h>

#include <utility>

namespace relume::stability {

Workbench::Workbench(Options options) : options_(std::move(options)), cache_(options_.cache) {}

std::shared_ptr<const served::Scene> Workbench::baked(const std::string& builtin,
                                                      const SceneSize& size) {
    const std::string image = fmt::format("{}x{}", size.width, size.height);
    std::string name =
        fmt::format("{}-{}-{}-{}", builtin, image, size.face_resolution, size.bounces);
    std::vector<std::string> words{"--builtin",
                                   builtin,
                                   "--size",
                                   image,
                                   "--light-resolution",
                                   std::to_string(size.face_resolution),
                                   "--bounces",
                                   std::to_string(size.bounces),
                                   "--samples",
                                   "16"};
    if (size.sh_order != 0) {
        const std::string order = std::to_string(size.sh_order);
        name += "-sh" + order;
        words.insert(words.end(), {"--basis", "sh", "--order", order});
    }
    auto& scene = scenes_[name];
    if (!scene) {
        scene = cache_.baked(name, words);
    }
    return scene;
}

std::shared_ptr<const served::Scene> Workbench::tiny(std::uint32_t channels) {
    const std::string name = fmt::format("tiny-{}", channels);
    auto& scene = scenes_[name];
    if (!scene) {
        // What has been opened is mapped and outlives its folder.
        const test::ScratchDirectory scratch;
        const auto directory = scratch.path() / (name + ".relume");
        test::write_tiny_transport(directory, {.channels = channels});
        scene = std::make_shared<const served::Scene>(transport::Transport::open(directory));
    }
    return scene;
}

}  // namespace relume::stability
