// Every failure there is a test of. To add one: a file, a declaration and a line in
// failures.cpp.
#pragma once

#include "tests/stability/failure.h"

#include <span>

namespace relume::stability {

[[nodiscard]] std::span<const Failure> failures();

}  // namespace relume::stability
