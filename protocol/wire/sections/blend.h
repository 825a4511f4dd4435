// A second map, mixed with the first.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

// Radiance (1 − amount)·environment + amount·(environment `name`, under the same gain and
// tint).
struct Blend {
    std::optional<std::string> name;
    double amount = 0;

    friend bool operator==(const Blend&, const Blend&) = default;
};

inline constexpr std::array kBlendFields{
    field::name<&Blend::name>("name", "the second map; without one there is none to mix"),
    field::number<&Blend::amount>(
        "amount",
        {0, 1},
        "radiance is `(1−amount)·environment + amount·blend`, gain and tint on both"),
};

inline constexpr Section<Blend> kBlend{"blend", Stage::signal,
                                       "A second map, mixed with the first", kBlendFields};

}  // namespace relume::wire
