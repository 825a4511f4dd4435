// What a file of a material is refused for.
#pragma once

#include <stdexcept>

namespace relume::tripling {

// The message names the file, what was found and what was expected.
class MaterialFileError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::tripling
