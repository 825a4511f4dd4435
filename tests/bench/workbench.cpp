#include "tests/bench/workbench.h"

#include "tests/bench/dense_transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

namespace relume::bench {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const served::Scene> open_scene(const fs::path& directory) {
    return std::make_shared<const served::Scene>(transport::Transport::open(directory));
}

}  // namespace

Workbench::Workbench(Options options) : options_(std::move(options)), scenes_(options_.cache) {}

std::shared_ptr<const served::Scene> Workbench::scene() {
    if (!scene_) {
        scene_ =
            options_.scene.empty()
                ? scenes_.baked("mesh100k-512-64", {"--builtin", "mesh100k", "--bounces", "0"})
                : open_scene(options_.scene);
    }
    return scene_;
}

std::shared_ptr<const served::Scene> Workbench::dense_scene() {
    if (!dense_scene_) {
        const DenseTransportSize size = quick() ? kQuickDenseTransport : kDenseTransport;
        const fs::path directory =
            options_.cache /
            fmt::format("dense-{}x{}-{}.relume", size.width, size.height, size.face_resolution);
        dense_scene_ = test::open_if_whole(directory);
        if (!dense_scene_) {
            fmt::print(stderr, "writing {} (once)\n", directory.string());
            write_dense_transport(directory, size);
            dense_scene_ = open_scene(directory);
        }
    }
    return dense_scene_;
}

std::shared_ptr<const served::Scene> Workbench::drift_scene() {
    return scenes_.baked("drift-32-8",
                         {"--builtin", "table", "--size", "32x32", "--light-resolution", "8",
                          "--bounces", "1", "--samples", "16"});
}

std::shared_ptr<const served::Scene> Workbench::flagship_scene() {
    return scenes_.baked("flagship-1920-64",
                         {"--builtin", "table", "--size", "1920x1080", "--bounces", "1"});
}

ReadBandwidth& Workbench::read_bandwidth() {
    if (!read_bandwidth_) {
        constexpr std::size_t kBytes = std::size_t{1} << 30U;
        constexpr std::size_t kQuickBytes = std::size_t{64} << 20U;
        read_bandwidth_ = std::make_unique<ReadBandwidth>(quick() ? kQuickBytes : kBytes);
    }
    return *read_bandwidth_;
}

std::vector<int> Workbench::thread_counts() {
    return std::thread::hardware_concurrency() > 1 ? std::vector<int>{1, 2}
                                                   : std::vector<int>{1};
}

}  // namespace relume::bench
