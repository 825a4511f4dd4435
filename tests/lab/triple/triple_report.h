// What relume-lab triple prints.
#pragma once

#include "tests/lab/triple/kept_products.h"
#include "tests/lab/triple/moving_scene.h"
#include "tests/lab/triple/seen_surface.h"
#include "tests/lab/triple/triple_experiment.h"

#include <nlohmann/json.hpp>

namespace relume::lab {

// Of the visibility: how large it is, and how its bake went, as the bake's report has it.
// Throws std::runtime_error where the report is not there.
[[nodiscard]] nlohmann::json json_from(const SeenSurface& surface);
[[nodiscard]] nlohmann::json json_from(const MaterialFindings& findings,
                                       const TermCurve& curve);
[[nodiscard]] nlohmann::json json_from(const MovingFigures& figures);
[[nodiscard]] nlohmann::json json_from(const KeptProducts& kept);

// One surface, `visibility` and `materials` as above, as tables.
void print_triple_tables(const nlohmann::json& surface);

}  // namespace relume::lab
