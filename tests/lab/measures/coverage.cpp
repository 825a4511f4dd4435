#include "tests/lab/measures/coverage.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"

#include <algorithm>

namespace relume::lab {

std::vector<std::uint8_t> covered_levels(std::uint32_t face_resolution,
                                         const std::vector<bool>& updated) {
    const std::size_t count = basis::texel_count(face_resolution);
    // Places of all levels of all faces: level ℓ has 2^ℓ × 2^ℓ a face.
    std::vector<std::uint8_t> levels(count);
    for (std::uint32_t band = 0; band < basis::band_count(face_resolution); ++band) {
        const std::uint32_t side = 1U << band;                // places along a face
        const std::uint32_t texels = face_resolution / side;  // along a place
        std::vector<bool> covered(std::size_t{basis::kFaceCount} * side * side);
        for (std::size_t j = 0; j < count; ++j) {
            if (updated[j] && basis::band_from_coefficient(face_resolution, j) == band) {
                const basis::Texel place = basis::texel_from_index(face_resolution, j);
                covered[(static_cast<std::size_t>(place.face) * side + place.row % side) *
                            side +
                        place.column % side] = true;
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            const basis::Texel texel = basis::texel_from_index(face_resolution, i);
            levels[i] = static_cast<std::uint8_t>(
                levels[i] +
                (covered[(static_cast<std::size_t>(texel.face) * side + texel.row / texels) *
                             side +
                         texel.column / texels]
                     ? 1
                     : 0));
        }
    }
    return levels;
}

}  // namespace relume::lab
