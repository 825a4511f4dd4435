// A method of relighting with its budget, as the lab names it: "pbi-30", "nwa-100-area",
// "guarded-400kB-benefit".
#pragma once

#include "protocol/wire/session_state.h"
#include "server/engine/selection.h"

#include <string>
#include <string_view>

namespace relume::lab {

struct Method {
    wire::Strategy strategy;
    engine::SelectionBudget budget;  // per image, in columns or in bytes
    std::string budget_text;         // as it was given

    [[nodiscard]] std::string label() const;
};

// METHOD-BUDGET[-PRIORITY]: the budget is a number of coefficients or, with B, kB or MB after
// it, of bytes (10³, 10⁶) of their columns; the priority is area when left out, as in the
// papers. Throws std::invalid_argument naming what was found and what is expected.
[[nodiscard]] Method method_from_text(std::string_view text);

}  // namespace relume::lab
