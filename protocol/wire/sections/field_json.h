// Values of fields from and to JSON, by their rules.
#pragma once

#include "protocol/wire/sections/field.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::wire {

// Null for none.
[[nodiscard]] nlohmann::json json_from_value(const FieldValue& value);

// The value that a patch states as JSON, checked by the rule. Null is taken only for an
// optional field; directions and quaternions are normalised. Throws WireError{wrong_type} or
// {out_of_range} at `path`.
[[nodiscard]] FieldValue value_from_json(const FieldRule& rule,
                                         const nlohmann::json& value,
                                         const std::string& path);

// The JSON by which a normalised patch states `value`, which was read from `stated`. Triples
// and tables stay as they were stated.
[[nodiscard]] nlohmann::json normal_form(const FieldRule& rule,
                                         const FieldValue& value,
                                         const nlohmann::json& stated);

// Divides `numbers` by their length unless that is one already to rounding, so that normalising
// twice gives the same bits as normalising once. Throws WireError{out_of_range} at `path`,
// quoting `value`, where all are zero.
void normalise(std::vector<double>& numbers,
               const std::string& path,
               const nlohmann::json& value);

}  // namespace relume::wire
