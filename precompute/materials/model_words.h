// The models of material fields as people write them.
#pragma once

#include "precompute/materials/field_model.h"

#include <string_view>

namespace relume::materials {

// Models, and what they are made of where nothing is said:
//     lambert[:colour=1/1/1]
//     phong[:exponent=64][,colour=1/1/1]
//     ggx[:roughness=0.3][,base=0.8/0.8/0.8][,metallic=0]
//     measured:FILE       a file of the MERL database (factors/merl_brdf.h)
// A colour is three numbers from 0 to 1, or one for all three. Throws program::UsageError for
// other words and for numbers out of range, factors::FactorError and files::FileError for what
// cannot be read.
[[nodiscard]] FieldModel model_from_words(std::string_view words);

}  // namespace relume::materials
