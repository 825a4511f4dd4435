// What the bake refuses.
#pragma once

#include <stdexcept>
#include <string>

namespace relume::bake {

// The message names the parameter or file, what was found and what was expected.
class BakeError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// The caller asked to stop; finished shards stay and the next bake goes on from them.
class BakeInterrupted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::bake
