// What an experiment with clustered PCA comes to, as the lab's programs print it.
#pragma once

#include "tests/lab/cpca/cpca_experiment.h"

#include <nlohmann/json.hpp>

namespace relume::lab {

// One object of numbers: `cpca_bytes_over_plain`, of the shorter way to cluster at the error
// asked, and its `cpca_added_error`; `cpca_step2_gain`, how many times as fast the second step
// is by its largest changes, and what these add in the mean and in the worst image;
// `seam_ratio`, RMS jumps of the error across borders of clusters over jumps within them, under
// the worse kind of light, and `seam_ratio_shown` of radiance, over the exact radiance's ratio.
[[nodiscard]] nlohmann::json cpca_figures(const CpcaFindings& findings);

// All that was found, `cpca_figures` among it.
[[nodiscard]] nlohmann::json json_from_cpca(const CpcaFindings& findings);

}  // namespace relume::lab
