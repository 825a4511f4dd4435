// A finish that changes from one state to another: the number of a family, and colours.
#pragma once

#include "protocol/wire/object_reader.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace relume::cli {

struct FinishChange {
    using Colours = std::vector<Imath::V3d>;  // of every lobe

    std::string part;
    std::string material;
    // From one to the other by equal factors, both above 0: steps of a family are apart by
    // such.
    std::optional<std::array<double, 2>> parameter;
    // From those to these, as many, in equal parts of the way.
    std::optional<std::array<Colours, 2>> colours;

    // The edit at `way` in [0, 1].
    [[nodiscard]] nlohmann::json patch_at(double way) const;
};

// Asks for `part` and `material`, which must be there, and for `parameter` and `colours` as
// [from, to], one of which must be. Throws wire::WireError.
[[nodiscard]] FinishChange finish_change_from(wire::ObjectReader& reader);

}  // namespace relume::cli
