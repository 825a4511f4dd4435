// Parts of a scene that are given other materials than they were baked with, where every vertex
// knows what it sees of the light.
#pragma once

#include "protocol/wire/sections/section.h"

#include <Imath/ImathVec.h>

#include <map>
#include <optional>
#include <string>

namespace relume::wire {

// A part without an entry is as it was baked.
struct Finish {
    std::string material;
    std::optional<double> parameter;     // of a family
    std::optional<NumberTable> colours;  // [lobes][r, g, b]; the material's own without

    friend bool operator==(const Finish&, const Finish&) = default;
};

using Finishes = std::map<std::string, Finish>;

[[nodiscard]] inline Finish fresh_finish(const Finishes& /*others*/) {
    return {};
}

inline constexpr std::uint32_t kMostLobes = 4;

inline constexpr std::array kFinishFields{
    field::name<&Finish::material>("material", "by its name in `/api/materials`").needed(),
    field::number<&Finish::parameter>(
        "parameter", {0, 1e5}, "of a family of materials, such as the exponent of Phong"),
    field::table<&Finish::colours>("colours",
                                   {1, kMostLobes, 3},
                                   kColour,
                                   "of the material's lobes; without them they are its own"),
};

inline constexpr KeyedSection<Finish> kFinishes{
    {"finishes", Stage::signal, "Materials given to parts of the scene, by the part's ID",
     kFinishFields},
    "finish",
    "finishes",
    fresh_finish,
    &Limits::finishes_per_room};

}  // namespace relume::wire
