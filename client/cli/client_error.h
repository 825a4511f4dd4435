// What the client reports and ends with exit code 1: what was found, what was expected.
#pragma once

#include <stdexcept>
#include <string>

namespace relume::cli {

class ClientError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace relume::cli
