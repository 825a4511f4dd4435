// What cannot be factored.
#pragma once

#include <stdexcept>

namespace relume::factors {

// The message says what was found and what was expected.
class FactorError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::factors
