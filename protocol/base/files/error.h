// What reading and writing files refuses.
#pragma once

#include <stdexcept>
#include <string>

namespace relume::files {

// The message names the file and what the system says, or what was found and expected.
class FileError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::files
