// The bytes of a list of factored BRDFs (`brdfs.bin` of a transport directory, ../README.md
// §2). Thread-safe.
#pragma once

#include "protocol/brdf/factored_brdf.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace relume::brdf {

inline constexpr std::size_t kMostBrdfs = 4096;

// Throws BrdfError when one is not valid or there are none, or too many.
[[nodiscard]] std::vector<std::byte> bytes_from_brdfs(std::span<const FactoredBrdf> brdfs);

// Every count is checked against the length of `bytes` before anything is allocated for it, and
// nothing may be left over. Throws BrdfError, which begins with `file`.
[[nodiscard]] std::vector<FactoredBrdf> brdfs_from_bytes(std::string_view file,
                                                         std::span<const std::byte> bytes);

}  // namespace relume::brdf
