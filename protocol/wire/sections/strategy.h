// By which method and in which order changed coefficients reach the image.
#pragma once

#include "protocol/relighting/strategy.h"
#include "protocol/wire/sections/section.h"

namespace relume::wire {

inline constexpr std::array kStrategyFields{
    field::word<&relighting::Strategy::method, relighting::kMethodNames>(
        "method", "what becomes of the approximation when the light changes"),
    field::word<&relighting::Strategy::priority, relighting::kPriorityNames>(
        "priority", "what a coefficient's change is weighted with to rank it"),
};

inline constexpr Section<relighting::Strategy> kStrategy{
    "strategy", Stage::policy, "How changed coefficients reach the image", kStrategyFields};

}  // namespace relume::wire
