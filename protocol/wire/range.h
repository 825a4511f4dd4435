// Bounds of a number, both of them allowed.
#pragma once

namespace relume::wire {

struct Range {
    double lowest = 0;
    double highest = 0;
};

}  // namespace relume::wire
