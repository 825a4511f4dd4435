// What the failures share: how much effort to spend, and scenes that are made when missing.
#pragma once

#include "server/scene/scene.h"
#include "tests/support/scene_cache.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace relume::stability {

enum class Effort {
    brief,  // seconds a failure: part of tests/run
    thorough,
};

// Image size and lighting of a built-in scene, and in which basis.
struct SceneSize {
    std::uint32_t width = 96;
    std::uint32_t height = 72;
    std::uint32_t face_resolution = 32;
    std::uint32_t bounces = 0;
    std::uint32_t sh_order = 0;  // of spherical harmonics; 0: wavelets
};

// Not thread-safe.
class Workbench {
  public:
    struct Options {
        Effort effort = Effort::brief;
        std::filesystem::path cache;  // where scenes are kept; made when missing
        std::uint64_t seed = 1;
        // Told what is being done, and which part of it is finished, in [0, 1].
        std::function<void(std::string_view what, double part)> progress = [](std::string_view,
                                                                              double) {};
    };

    explicit Workbench(Options options);

    // One of two amounts of work.
    template <typename T>
    [[nodiscard]] T choose(T brief, T thorough) const {
        return options_.effort == Effort::brief ? brief : thorough;
    }
    [[nodiscard]] std::uint64_t seed() const { return options_.seed; }
    [[nodiscard]] const std::filesystem::path& cache() const { return cache_.folder(); }
    void progress(std::string_view what, double part) const { options_.progress(what, part); }

    // Baked when it is not in the cache, which takes seconds.
    [[nodiscard]] std::shared_ptr<const served::Scene> baked(const std::string& builtin,
                                                             const SceneSize& size = {});
    // Random transport of 40×24 pixels and 6×8×8 lights in all encodings
    // (tests/support/tiny_transport.h), in a tenth of a second.
    [[nodiscard]] std::shared_ptr<const served::Scene> tiny(std::uint32_t channels);

  private:
    Options options_;
    test::SceneCache cache_;
    std::map<std::string, std::shared_ptr<const served::Scene>> scenes_;
};

}  // namespace relume::stability
