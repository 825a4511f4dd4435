// What one image may take, and when it is good enough.
#pragma once

#include <cstdint>
#include <optional>

namespace relume::relighting {

// Per image: exactly one of `milliseconds` and `coefficients` is set.
struct Budget {
    std::optional<double> milliseconds = 8;
    std::optional<std::uint32_t> coefficients;
    double target_error = 0;  // relative L2; 0 asks for exact

    friend bool operator==(const Budget&, const Budget&) = default;
};

}  // namespace relume::relighting
