// The way of a camera through keys.
#pragma once

#include "protocol/wire/object_reader.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace relume::cli {

struct CameraKey {
    Imath::V3d eye;
    Imath::V3d look_at;
    std::optional<Imath::V3d> up;
    std::optional<double> fov_degrees;
};

// Passes through all keys, at equal parts of the way from one to the next. In between, eye and
// look_at lie on Catmull and Rom's spline through the keys, `up` between its neighbours, and
// the field of view changes by equal factors.
class CameraPath {
  public:
    static constexpr std::size_t kMostKeys = 1000;

    // 2 … kMostKeys; all have the fields that the first one has.
    explicit CameraPath(std::vector<CameraKey> keys);

    // The edit of section `camera` at `way`, 0 … 1.
    [[nodiscard]] nlohmann::json patch_at(double way) const;
    [[nodiscard]] const std::vector<CameraKey>& keys() const { return keys_; }

  private:
    std::vector<CameraKey> keys_;
};

// An array of keys, each an object as section `camera` of a room's state. The first one states
// eye and look_at; what another one leaves out is as in the key before, and what the first one
// leaves out stays as it is in the room. Throws wire::WireError.
[[nodiscard]] CameraPath camera_path_from_json(const nlohmann::json& keys,
                                               const std::string& path);

}  // namespace relume::cli
