// What a part of a scene is given in place of the material that it was baked with.
#pragma once

#include "server/triple/texel_material.h"

#include <Imath/ImathVec.h>

#include <memory>
#include <optional>
#include <vector>

namespace relume::triple {

// A tabulated material with colours for its lobes; or one between two steps of a family, such as
// two exponents of Phong, whose tables are blended. Copies are cheap: they share the tables.
struct Finish {
    using SharedMaterial = std::shared_ptr<const TexelMaterial>;

    // Nothing: black.
    Finish() = default;
    // With the material's own colours where none are given. Throws std::invalid_argument where
    // colours are not as many as lobes.
    Finish(SharedMaterial only,  // NOLINT(google-explicit-constructor): a material is a finish
           std::optional<std::vector<Imath::V3f>> lobe_colours = std::nullopt);
    // (1 − amount)·first + amount·second, with amount in [0, 1]. Throws std::invalid_argument
    // also where both do not have the same face resolution and as many lobes.
    Finish(SharedMaterial first,
           SharedMaterial second,
           float amount,
           std::optional<std::vector<Imath::V3f>> lobe_colours = std::nullopt);

    [[nodiscard]] bool depends_on_view() const;

    SharedMaterial material;
    SharedMaterial next;  // null: `material` alone
    float amount_of_next = 0;
    std::vector<Imath::V3f> colours;  // [lobes]

    friend bool operator==(const Finish&, const Finish&) = default;
};

}  // namespace relume::triple
