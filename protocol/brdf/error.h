// What a factored BRDF refuses.
#pragma once

#include <stdexcept>

namespace relume::brdf {

// The message says what was found and what was expected.
class BrdfError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::brdf
