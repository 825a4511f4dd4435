// Records as CSV and JSON.
#pragma once

#include "tests/lab/measures/record.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::lab {

// A heading and an image a row; what was not measured is empty. Reproducible columns have all
// digits that tell their doubles apart.
[[nodiscard]] std::string csv_from_records(const std::vector<Record>& records);

// An object a record, the CSV's columns as keys (null: not measured), and "bands", an array of
// {"updated", "residual_energy", "change_energy"}.
[[nodiscard]] nlohmann::json json_from_records(const std::vector<Record>& records);

}  // namespace relume::lab
