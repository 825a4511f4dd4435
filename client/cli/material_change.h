// A material that changes from one state to another: parameters of its curve, and colours.
#pragma once

#include "protocol/wire/object_reader.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace relume::cli {

struct MaterialChange {
    // A field of the section `materials` that is a number or three of them. It goes from one
    // value to the other in equal parts of the way, three by channel.
    struct Field {
        std::string key;
        bool is_triple = false;
        Imath::V3d from;  // all three alike where it is one number
        Imath::V3d to;
    };

    std::string id;
    std::string shape;  // empty: none is stated
    std::vector<Field> fields;

    // The edit at `way` in [0, 1].
    [[nodiscard]] nlohmann::json patch_at(double way) const;
};

// Asks for `id`, which must be there, `shape`, and the fields as [from, to], one of which must
// be. Throws wire::WireError.
[[nodiscard]] MaterialChange material_change_from(wire::ObjectReader& reader);

}  // namespace relume::cli
