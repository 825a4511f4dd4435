// A method of relighting with its budget, as the lab names it: "pbi-30", "nwa-100-area".
#pragma once

#include "protocol/wire/session_state.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace relume::lab {

struct Method {
    wire::Strategy strategy;
    std::uint32_t coefficients = 30;  // per image

    [[nodiscard]] std::string label() const;
};

// METHOD-COEFFICIENTS[-PRIORITY], the priority being area when left out, as in the papers.
// Throws std::invalid_argument naming what was found and what is expected.
[[nodiscard]] Method method_from_text(std::string_view text);

}  // namespace relume::lab
