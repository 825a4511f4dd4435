// A small valid transport of kind `curves`, of random columns.
#pragma once

#include "tests/support/tiny_transport.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relume::test {

// Materials of these ids, each with the curve `distribution` of a GGX of its own roughness.
void write_tiny_curves(const std::filesystem::path& directory,
                       const std::vector<std::string>& ids,
                       const TinyTransportOptions& options = {});

}  // namespace relume::test
