// A way in which relighting can fail: a scene that provokes it, and what was found there.
#pragma once

#include "tests/stability/contact_sheet.h"
#include "tests/stability/finding.h"
#include "tests/stability/workbench.h"

#include <string_view>
#include <vector>

namespace relume::stability {

struct Outcome {
    std::vector<Finding> findings;
    std::vector<Tile> tiles;  // shown side by side
};

struct Failure {
    std::string_view name;   // "ghosts": its name in README.md of this folder, too
    std::string_view what;   // one sentence: what goes wrong
    std::string_view scene;  // what provokes it
    // The same numbers for the same seed and effort, on any number of threads.
    Outcome (*provoke)(Workbench&);
};

}  // namespace relume::stability
