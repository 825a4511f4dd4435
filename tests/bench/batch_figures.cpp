// Sixteen sessions of one scene in one sweep against each by itself.
#include "tests/bench/figure_groups.h"

namespace relume::bench {
namespace {

constexpr const char* kKeys[] = {"batch_gain_resting", "batch_gain_dragging"};

void measure(Workbench& /*workbench*/, Results& results) {
    for (const char* key : kKeys) {
        results.omit(key, "the engine relights each session by itself");
    }
}

}  // namespace

FigureGroup batch_figures() {
    return {.figures = {{.key = kKeys[0],
                         .meaning = "16 sessions at rest, alone / batched",
                         .aim = Aim::at_least,
                         .target = 3},
                        {.key = kKeys[1],
                         .meaning = "16 sessions dragging, 30 terms, alone / batched",
                         .aim = Aim::reported}},
            .measure = measure};
}

}  // namespace relume::bench
