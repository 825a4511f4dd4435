// How a picture is developed from linear light: the reference of it is ../display.h.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

enum class Tone : std::uint8_t { filmic, linear };

inline constexpr text::NameTable<Tone, 2> kToneNames({{
    {Tone::filmic, "filmic"},
    {Tone::linear, "linear"},
}});

struct Display {
    double exposure_stops = 0;
    Tone tone = Tone::filmic;

    friend bool operator==(const Display&, const Display&) = default;
};

inline constexpr auto kExposureStopsField = field::number<&Display::exposure_stops>(
    "exposure_stops", {-20, 20}, "light is multiplied by 2 to the power of it");
inline constexpr auto kToneField =
    field::word<&Display::tone, kToneNames>("tone", "the tone curve: §3.2");

inline constexpr std::array kDisplayFields{kExposureStopsField, kToneField};

inline constexpr Section<Display> kDisplay{
    "display", Stage::display, "How pictures are developed for who has chosen nothing else",
    kDisplayFields};

}  // namespace relume::wire
