// What a curve refuses.
#pragma once

#include <stdexcept>

namespace relume::curve {

// The message says what was found and what was expected.
class CurveError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::curve
