// The families of methods, a file each; method_registry.cpp lists them.
#pragma once

#include "tests/lab/methods/method.h"

#include <vector>

namespace relume::lab {

// nwa, bi, pbi, guarded: what the server runs.
void add_session_families(std::vector<MethodFamily>& families);
// pbi-dealer, pbi-exhaustive: which bands begin anew, chosen with more care.
void add_selector_families(std::vector<MethodFamily>& families);

}  // namespace relume::lab
