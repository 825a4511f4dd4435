// Why an environment map, or a file that should hold one, was refused.
#pragma once

#include <stdexcept>
#include <string>

namespace relume::light {

// what() is complete by itself and names both `found` and `expected` where there are such; the
// two are kept apart for the wire, which states them in fields of their own. Either may be
// empty.
class EnvironmentError : public std::runtime_error {
  public:
    explicit EnvironmentError(const std::string& message,
                              std::string found = {},
                              std::string expected = {})
        : std::runtime_error(message),
          found_(std::move(found)),
          expected_(std::move(expected)) {}

    [[nodiscard]] const std::string& found() const { return found_; }
    [[nodiscard]] const std::string& expected() const { return expected_; }

  private:
    std::string found_;
    std::string expected_;
};

}  // namespace relume::light
