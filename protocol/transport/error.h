// What the transport directory refuses, by name of file and section.
#pragma once

#include <stdexcept>
#include <string>

namespace relume::transport {

// The message names the file, the section, what was found and what was expected.
class TransportError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::transport
