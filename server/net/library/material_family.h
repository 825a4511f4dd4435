// A material that parts of scenes may be given: one file, or several that differ in one number.
#pragma once

#include "protocol/wire/offered_material.h"
#include "server/net/library/tabulated_material.h"
#include "server/triple/finish.h"

#include <Imath/ImathVec.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace relume::net {

// What the stem of a file says: NAME, or FAMILY-PARAMETER-NUMBER with PARAMETER one of
// `exponent` and `roughness`, as phong-exponent-64.
struct MaterialName {
    std::string name;
    std::optional<std::string> parameter;  // of a step of a family
    double step = 0;
};
[[nodiscard]] MaterialName material_name_from_stem(const std::string& stem);

// All steps have one face resolution and as many lobes. Immutable; safe to share between
// threads.
struct MaterialFamily {
    struct Step {
        double number = 0;
        std::shared_ptr<TabulatedMaterial> material;
    };

    std::string name;
    std::optional<std::string> parameter;  // none: one step alone, whose number means nothing
    std::vector<Step> steps;               // ascending, one at least

    [[nodiscard]] const TabulatedMaterial& first() const { return *steps.front().material; }
    [[nodiscard]] wire::OfferedMaterial description() const;
    // The material at a number, between two steps by the logarithm of the number; beyond the
    // last step and below the first that step. Without a number the step in the middle. Reads
    // files: throws as TabulatedMaterial::texels.
    [[nodiscard]] triple::Finish finish(std::optional<double> number,
                                        std::optional<std::vector<Imath::V3f>> colours) const;
};

}  // namespace relume::net
