// Findings for people and for programs.
#pragma once

#include "tests/stability/failure.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace relume::stability {

struct Result {
    Failure failure;
    Outcome outcome;

    [[nodiscard]] bool holds() const;
};

// "at most 0.0001"; "none" where none is claimed.
[[nodiscard]] std::string bound_text(const Finding& finding);
// "holds", "broken", "reported".
[[nodiscard]] std::string verdict_text(const Finding& finding);
// Verdict, measured value, bound, measure.
[[nodiscard]] std::string line_from(const Finding& finding);
// A heading a failure, a line a finding.
[[nodiscard]] std::string text_from(const Result& result);
// {"failures":[{"name","where","what","scene","holds","findings":[{"measure","sense","bound",
// "measured","reason","holds"}]}]}; the bound is left out where none is claimed.
[[nodiscard]] nlohmann::json json_from(std::span<const Result> results);

}  // namespace relume::stability
