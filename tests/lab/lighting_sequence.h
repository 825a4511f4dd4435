// What the light does, image by image.
#pragma once

#include "server/light/light_rig.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

struct LightingSequence {
    std::string name;
    std::string description;
    std::uint32_t images = 0;
    std::uint32_t rests_from =
        0;  // image from which the light rests; `images` if it never does
    // Light of image i; a function of i alone.
    std::function<light::LightRig(std::uint32_t)> rig;
};

// What sequences are made of.
struct LightingSources {
    std::shared_ptr<const light::PrefilteredEnvironment> environment;
    std::uint64_t seed = 1;
};

[[nodiscard]] std::vector<std::string> sequence_names();
// Throws std::invalid_argument naming the sequences there are.
[[nodiscard]] LightingSequence make_sequence(std::string_view name,
                                             const LightingSources& sources);

}  // namespace relume::lab
