// What light and camera do, image by image, as a file says it (README.md of this folder).
#pragma once

#include "protocol/light/light_rig.h"
#include "server/view/view.h"
#include "tests/lab/sequences/curve.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

// A round light at infinity; radiance zero: it is not there.
struct LightCurves {
    Curve azimuth_degrees = 0;     // from −Z towards +X
    Curve elevation_degrees = 90;  // above the horizon
    Curve radius_degrees = 1;
    Curve radiance = 1;
};

struct LightingSequence {
    std::string name;
    std::string description;
    std::uint32_t images = 0;
    std::uint64_t seed = 1;
    Curve yaw_degrees = 0;  // of the environment
    Curve pitch_degrees = 0;
    Curve roll_degrees = 0;
    Curve gain = 1;
    Curve blend = 0;  // part of the second environment, 0 to 1
    std::vector<LightCurves> lights;
    Curve orbit_degrees = 0;  // of the camera (geometry/orbit.h)

    // The first image from which on nothing changes any more; `images` if there is none.
    [[nodiscard]] std::uint32_t rests_from() const;
    // Whether some image is looked at from elsewhere than where views begin.
    [[nodiscard]] bool moves_camera() const;
};

// What sequences turn and blend; either may be missing and is black then.
struct Environments {
    std::shared_ptr<const light::PrefilteredEnvironment> environment;
    std::shared_ptr<const light::PrefilteredEnvironment> blend;
};

// Light of one image: a function of the sequence, its seed, and the image's number alone.
[[nodiscard]] light::LightRig rig_of_image(const LightingSequence& sequence,
                                           const Environments& environments,
                                           std::uint32_t image);

// Where that image is looked at from, by a view that begins with `beginning`.
[[nodiscard]] view::Look look_of_image(const LightingSequence& sequence,
                                       const view::Look& beginning,
                                       std::uint32_t image);

// Throws std::invalid_argument with a JSON pointer to what is wrong, what was found and
// expected. Names nobody knows are refused.
[[nodiscard]] LightingSequence sequence_from_json(const nlohmann::json& json);

// Of those in this folder, ascending.
[[nodiscard]] std::vector<std::string> sequence_names();
// One of these by name, or any file by its path. Throws std::invalid_argument naming the file
// or the sequences there are.
[[nodiscard]] LightingSequence load_sequence(const std::string& name_or_file);

}  // namespace relume::lab
