// What makes a scene unusable. Every message names the file, what was found and what was
// expected.
#pragma once

#include <stdexcept>
#include <string>

namespace relume::scene {

enum class SceneFault {
    missing_file,
    unsupported_format,
    corrupt_file,
    no_geometry,
    non_finite_vertex,
    all_degenerate,
    index_out_of_range,
    bad_texture,
    no_camera,
    bad_camera,
    too_large,
    unknown_name,
    unsupported_extension,
};

class SceneError : public std::runtime_error {
  public:
    SceneError(SceneFault fault, const std::string& message)
        : std::runtime_error(message), fault_(fault) {}
    [[nodiscard]] SceneFault fault() const { return fault_; }

  private:
    SceneFault fault_;
};

}  // namespace relume::scene
