// What one image may take, and when it is good enough.
#pragma once

#include "protocol/relighting/budget.h"
#include "protocol/wire/sections/section.h"

namespace relume::wire {

// The most columns that a scene can have, which is the count of the largest basis. A test
// compares the two.
inline constexpr std::uint32_t kMostColumns = 393216;

inline constexpr std::array kBudgetFields{
    field::number<&relighting::Budget::milliseconds>(
        "milliseconds",
        {0.1, 1000},
        "of an image from edit to encoded picture: relighting gets what is left of them")
        .one_of(),
    field::integer<&relighting::Budget::coefficients>(
        "coefficients",
        {1, kMostColumns},
        "applied for an image; from the scene's `columns` on it is all of them")
        .one_of(),
    field::number<&relighting::Budget::target_error>(
        "target_error", {0, 1}, "relative L2 at which an image has settled; 0 asks for exact"),
};

inline constexpr Section<relighting::Budget> kBudget{"budget", Stage::policy,
                                                     "What one image may take", kBudgetFields};

}  // namespace relume::wire
