// What shows behind the scene.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

enum class BackgroundMode : std::uint8_t { environment, colour, transparent };

inline constexpr text::NameTable<BackgroundMode, 3> kBackgroundModeNames({{
    {BackgroundMode::environment, "environment"},
    {BackgroundMode::colour, "colour"},
    {BackgroundMode::transparent, "transparent"},
}});

struct Background {
    BackgroundMode mode = BackgroundMode::environment;
    Imath::V3d colour{0.05, 0.05, 0.05};

    friend bool operator==(const Background&, const Background&) = default;
};

inline constexpr std::array kBackgroundFields{
    field::word<&Background::mode, kBackgroundModeNames>("mode", "what it is: §3.2"),
    field::triple<&Background::colour>("colour", kColour, "linear, in mode `colour`"),
};

inline constexpr Section<Background> kBackground{
    "background", Stage::view, "What shows behind the scene", kBackgroundFields};

}  // namespace relume::wire
