#include "client/cli/camera_path.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/sections/camera.h"
#include "protocol/wire/sections/field_json.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace relume::cli {
namespace {

using nlohmann::json;
using wire::ObjectReader;

json json_from(const Imath::V3d& v) {
    return {v.x, v.y, v.z};
}

// Between b and c, with a before and d after them.
Imath::V3d on_spline(const Imath::V3d& a,
                     const Imath::V3d& b,
                     const Imath::V3d& c,
                     const Imath::V3d& d,
                     double t) {
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                  (3.0 * b - a - 3.0 * c + d) * (t * t * t));
}

// What the key states of the section's fields, over what the key before it had.
void read_key(const json& object,
              const std::string& path,
              bool is_first,
              wire::Camera& camera,
              std::vector<std::string_view>& stated) {
    ObjectReader reader(object, path);
    for (const wire::Field<wire::Camera>& field : wire::kCameraFields) {
        const std::string_view key = field.rule.key;
        const bool is_needed = is_first && (key == "eye" || key == "look_at");
        const json* const value = is_needed ? &reader.require(key) : reader.find(key);
        if (value == nullptr) {
            continue;
        }
        if (is_first) {
            stated.push_back(key);
        } else if (std::find(stated.begin(), stated.end(), key) == stated.end()) {
            throw wire::WireError(wire::ErrorCode::missing_field, reader.path_to(key),
                                  std::string(key) + " for the first time",
                                  "it in the first key, too");
        }
        field.set(camera, wire::value_from_json(field.rule, *value, reader.path_to(key)));
    }
    reader.refuse_other_keys();
}

}  // namespace

CameraPath::CameraPath(std::vector<CameraKey> keys) : keys_(std::move(keys)) {}

json CameraPath::patch_at(double way) const {
    const double at = way * static_cast<double>(keys_.size() - 1);
    const std::size_t i =
        std::min(static_cast<std::size_t>(std::max(at, 0.0)), keys_.size() - 2);
    const double t = at - static_cast<double>(i);
    const CameraKey& b = keys_[i];
    const CameraKey& c = keys_[i + 1];
    const CameraKey& a = keys_[i == 0 ? 0 : i - 1];
    const CameraKey& d = keys_[std::min(i + 2, keys_.size() - 1)];
    json camera = {
        {"eye", json_from(on_spline(a.eye, b.eye, c.eye, d.eye, t))},
        {"look_at", json_from(on_spline(a.look_at, b.look_at, c.look_at, d.look_at, t))}};
    if (b.up && c.up) {
        const Imath::V3d between = *b.up * (1 - t) + *c.up * t;
        camera["up"] = json_from(between.length() > 1e-9 ? between : *c.up);
    }
    if (b.fov_degrees && c.fov_degrees) {
        camera["fov_degrees"] =
            t >= 1 ? *c.fov_degrees
                   : *b.fov_degrees * std::pow(*c.fov_degrees / *b.fov_degrees, t);
    }
    return {{"camera", std::move(camera)}};
}

CameraPath camera_path_from_json(const json& keys, const std::string& path) {
    if (!keys.is_array() || keys.size() < 2 || keys.size() > CameraPath::kMostKeys) {
        throw wire::WireError(
            wire::ErrorCode::wrong_type, path, wire::quote(keys),
            "an array of 2 … " + std::to_string(CameraPath::kMostKeys) + " keys");
    }
    wire::Camera camera;
    std::vector<std::string_view> stated;
    std::vector<CameraKey> read;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        read_key(keys[i], path + "/" + std::to_string(i), i == 0, camera, stated);
        const auto has = [&stated](std::string_view key) {
            return std::find(stated.begin(), stated.end(), key) != stated.end();
        };
        read.push_back({.eye = camera.eye,
                        .look_at = camera.look_at,
                        .up = has("up") ? std::optional(camera.up) : std::nullopt,
                        .fov_degrees = has("fov_degrees") ? std::optional(camera.fov_degrees)
                                                          : std::nullopt});
    }
    return CameraPath(std::move(read));
}

}  // namespace relume::cli
