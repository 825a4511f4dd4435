// Errors of the glTF reader: each names the file, the item, what was found, what was expected.
#pragma once

#include "precompute/scene/error.h"

#include <cstddef>
#include <string>
#include <utility>

namespace relume::scene::gltf {

// Every part of the reader carries one, to name the file in what it throws.
class FileName {
  public:
    explicit FileName(std::string shown) : shown_(std::move(shown)) {}

    // Throws SceneError "scene 'FILE': WHY".
    [[noreturn]] void refuse(SceneFault fault, const std::string& why) const;
    // Throws SceneError (corrupt_file) unless 0 ≤ index < count. `who` and `what` are words:
    // "mesh 3" refers to "accessor".
    std::size_t checked_index(long long index,
                              std::size_t count,
                              const std::string& who,
                              const char* what) const;
    [[nodiscard]] const std::string& shown() const { return shown_; }

  private:
    std::string shown_;
};

}  // namespace relume::scene::gltf
