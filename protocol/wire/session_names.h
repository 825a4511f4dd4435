// The words of the session state's enumerations.
#pragma once

#include "protocol/wire/name_table.h"
#include "protocol/wire/session_state.h"

namespace relume::wire {

inline constexpr NameTable<Method, 4> kMethodNames({{
    {Method::nwa, "nwa"},
    {Method::bi, "bi"},
    {Method::pbi, "pbi"},
    {Method::guarded, "guarded"},
}});

inline constexpr NameTable<Priority, 4> kPriorityNames({{
    {Priority::area, "area"},
    {Priority::none, "none"},
    {Priority::transport, "transport"},
    {Priority::benefit, "benefit"},
}});

inline constexpr NameTable<BackgroundMode, 3> kBackgroundModeNames({{
    {BackgroundMode::environment, "environment"},
    {BackgroundMode::colour, "colour"},
    {BackgroundMode::transparent, "transparent"},
}});

inline constexpr NameTable<Tone, 2> kToneNames({{
    {Tone::filmic, "filmic"},
    {Tone::linear, "linear"},
}});

}  // namespace relume::wire
