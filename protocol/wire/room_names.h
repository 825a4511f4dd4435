// The words of the room state's enumerations.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/wire/room_state.h"

namespace relume::wire {

inline constexpr text::NameTable<BackgroundMode, 3> kBackgroundModeNames({{
    {BackgroundMode::environment, "environment"},
    {BackgroundMode::colour, "colour"},
    {BackgroundMode::transparent, "transparent"},
}});

inline constexpr text::NameTable<Tone, 2> kToneNames({{
    {Tone::filmic, "filmic"},
    {Tone::linear, "linear"},
}});

}  // namespace relume::wire
