#include "tests/stability/workbench.h"

#include "precompute/bake/bake.h"
#include "precompute/scene/builtin.h"
#include "protocol/transport/error.h"
#include "protocol/transport/transport.h"
#include "tests/support/tiny_transport.h"

#include <fmt/format.h>

#include <utility>

namespace relume::stability {
namespace {

// Opens what is there and of today's format; makes it anew otherwise.
std::shared_ptr<const engine::Scene> open_or_make(const std::filesystem::path& directory,
                                                  const std::function<void()>& make) {
    try {
        return std::make_shared<const engine::Scene>(transport::Transport::open(directory));
    } catch (const transport::TransportError&) {
        std::filesystem::remove_all(directory);
        make();
    }
    return std::make_shared<const engine::Scene>(transport::Transport::open(directory));
}

}  // namespace

Workbench::Workbench(Options options) : options_(std::move(options)) {
    std::filesystem::create_directories(options_.cache);
}

std::shared_ptr<const engine::Scene> Workbench::baked(const std::string& builtin,
                                                      const SceneSize& size) {
    const std::string name = fmt::format("{}-{}x{}-{}-{}", builtin, size.width, size.height,
                                         size.face_resolution, size.bounces);
    auto& scene = scenes_[name];
    if (!scene) {
        const auto directory = options_.cache / (name + ".relume");
        scene = open_or_make(directory, [&] {
            bake::BakeParameters parameters;
            parameters.width = size.width;
            parameters.height = size.height;
            parameters.face_resolution = size.face_resolution;
            parameters.bounces = size.bounces;
            parameters.samples = 16;
            progress("bake " + name, 0);
            bake::bake(scene::build_builtin_scene(builtin), parameters, directory);
        });
    }
    return scene;
}

std::shared_ptr<const engine::Scene> Workbench::tiny(std::uint32_t channels) {
    const std::string name = fmt::format("tiny-{}", channels);
    auto& scene = scenes_[name];
    if (!scene) {
        const auto directory = options_.cache / (name + ".relume");
        scene = open_or_make(
            directory, [&] { test::write_tiny_transport(directory, {.channels = channels}); });
    }
    return scene;
}

}  // namespace relume::stability
