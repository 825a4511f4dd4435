// What one image may take, and when it is good enough.
#pragma once

#include "protocol/relighting/budget.h"
#include "protocol/wire/sections/section.h"

namespace relume::wire {

inline constexpr std::array kBudgetFields{
    field::number<&relighting::Budget::milliseconds>(
        "milliseconds",
        {0.1, 1000},
        "of an image from edit to encoded picture: relighting gets what is left of them")
        .one_of(),
    field::integer<&relighting::Budget::coefficients>(
        "coefficients", {1, 393216}, "applied for an image")
        .one_of(),
    field::number<&relighting::Budget::target_error>(
        "target_error", {0, 1}, "relative L2 at which an image has settled; 0 asks for exact"),
};

inline constexpr Section<relighting::Budget> kBudget{"budget", Stage::policy,
                                                     "What one image may take", kBudgetFields};

}  // namespace relume::wire
