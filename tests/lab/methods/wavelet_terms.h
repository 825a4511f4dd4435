// What a wavelet method may spend on an image, and by what it ranks: BUDGET[-PRIORITY].
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/choosing/selection.h"

#include <string>
#include <string_view>

namespace relume::lab {

struct WaveletTerms {
    engine::SelectionBudget budget;  // per image, in columns or in bytes
    relighting::Priority priority = relighting::Priority::area;
    std::string text;  // complete: "30-area"

    [[nodiscard]] bool counts_bytes() const;
};

inline constexpr std::string_view kWaveletTermsForm = "BUDGET[-PRIORITY]";

// The budget is a number of coefficients or, with B, kB or MB after it, of bytes (10³, 10⁶) of
// their columns; the priority is area when left out, as in the papers. Throws
// std::invalid_argument naming what was found and what is expected.
[[nodiscard]] WaveletTerms wavelet_terms_from_text(std::string_view text);

}  // namespace relume::lab
