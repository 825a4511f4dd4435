// The families of methods, a file each; method_registry.cpp lists them.
#pragma once

#include "tests/lab/methods/method.h"

#include <vector>

namespace relume::lab {

// nwa, bi, pbi, guarded: what the server runs; full: the whole product.
void add_session_families(std::vector<MethodFamily>& families);
// pbi-l2, pbi-dealer, pbi-exhaustive and their likes in L2: selectors of [Overbeck06T 6.2].
void add_selector_families(std::vector<MethodFamily>& families);
// sh, pbi-sh, pbi-sh-filled: the same view in spherical harmonics.
void add_sh_families(std::vector<MethodFamily>& families);

// factored, cpca: over a surface's vertices, under a camera that may move.
void add_surface_families(std::vector<MethodFamily>& families);

}  // namespace relume::lab
