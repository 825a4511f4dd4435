// How fast methods follow a curve that is edited, and in how many images they are exact.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/scene/scene.h"
#include "tests/lab/curves/curve_edits.h"

#include <cstdint>
#include <memory>

namespace relume::lab {

struct CurveConvergence {
    double mean_error = 0;              // relative L2 of the images of a drag, root mean square
    double largest_error = 0;           // of its images
    std::uint32_t images_to_exact = 0;  // from its last change until every column is right
};

// A drag of `images` images of so many columns each, by the method alone.
[[nodiscard]] CurveConvergence curve_convergence(std::shared_ptr<const served::Scene> scene,
                                                 std::uint32_t material,
                                                 relighting::Method method,
                                                 CurveChange change,
                                                 std::uint32_t columns,
                                                 std::uint32_t images);

// Images of so many columns until exact, from one change alone: the largest of `changes`.
[[nodiscard]] std::uint32_t images_to_exact_after_one_change(
    std::shared_ptr<const served::Scene> scene,
    std::uint32_t material,
    CurveChange change,
    std::uint32_t columns,
    std::uint32_t changes);

}  // namespace relume::lab
