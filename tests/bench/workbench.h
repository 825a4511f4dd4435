// What the experiments share: options, scenes made when missing, the machine's read bandwidth.
#pragma once

#include "server/scene/scene.h"
#include "tests/bench/read_bandwidth.h"
#include "tests/support/scene_cache.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::bench {

struct Options {
    std::vector<std::string> only;  // keys; empty: all
    std::filesystem::path scene;    // empty: mesh100k of 512², 6×64×64, direct light
    std::filesystem::path cache;    // where scenes are kept
    bool flagship = false;
    bool quick = false;  // everything once and small: does it run, not how fast
};

// Not thread-safe. Scenes are opened once and kept.
class Workbench {
  public:
    explicit Workbench(Options options);

    [[nodiscard]] const Options& options() const { return options_; }
    [[nodiscard]] bool quick() const { return options_.quick; }

    // The scene of most figures; baked when it is missing and none was named.
    [[nodiscard]] std::shared_ptr<const served::Scene> scene();
    // Null until a figure asked for it.
    [[nodiscard]] std::shared_ptr<const served::Scene> scene_in_use() const { return scene_; }
    // Every cell of it is dense8, and it is far larger than the last-level cache.
    [[nodiscard]] std::shared_ptr<const served::Scene> dense_scene();
    // Small, so that a million edits take two minutes.
    [[nodiscard]] std::shared_ptr<const served::Scene> drift_scene();
    // 1920×1080 in colour, with a bounce. Baking it takes long and goes on where it stopped.
    [[nodiscard]] std::shared_ptr<const served::Scene> flagship_scene();

    [[nodiscard]] ReadBandwidth& read_bandwidth();

    // As many as the figures speak of: two, or one where the machine has no more.
    [[nodiscard]] static std::vector<int> thread_counts();

  private:
    Options options_;
    test::SceneCache scenes_;
    std::shared_ptr<const served::Scene> scene_;
    std::shared_ptr<const served::Scene> dense_scene_;
    std::unique_ptr<ReadBandwidth> read_bandwidth_;
};

}  // namespace relume::bench
