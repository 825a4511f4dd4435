#include "server/view/mesh/tile_pixels.h"

#include "server/view/mesh/rgb.h"
#include "server/view/mesh/vertex_radiance.h"

#include <cstring>

namespace relume::view {
namespace {

constexpr std::size_t kTerm = VertexRadiance::kFloatsPerTerm;

// What the point sends towards the eye. `weights` are moved on to those of the next point.
inline Rgb radiance_of(const TilePoint& point, const float* radiance, const float*& weights) {
    const float* const corner_0 = radiance + kTerm * point.first_terms[0];
    const float* const corner_1 = radiance + kTerm * point.first_terms[1];
    const float* const corner_2 = radiance + kTerm * point.first_terms[2];
    const std::size_t floats = kTerm * point.terms;
    Rgb sum{};
    for (std::size_t i = 0; i < floats; i += kTerm) {
        const Rgb here = point.shares[0] * load_rgb(corner_0 + i) +
                         point.shares[1] * load_rgb(corner_1 + i) +
                         point.shares[2] * load_rgb(corner_2 + i);
        sum += load_rgb(weights + i) * here;
    }
    weights += floats;
    return sum;
}

}  // namespace

void write_tile_pixels(const TileTerms& terms,
                       std::span<const float> radiance,
                       std::uint32_t columns,
                       std::size_t row_floats,
                       float* first) {
    const TilePoint* point = terms.points.data();
    const float* weights = terms.weights.data();
    std::size_t column = 0;
    for (const TilePixel& pixel : terms.pixels) {
        Rgb sum{};
        for (std::size_t i = 0; i < pixel.points; ++i) {
            sum += radiance_of(*point++, radiance.data(), weights);
        }
        if (pixel.places > 1) {
            sum *= 1.0F / static_cast<float>(pixel.places);
        }
        std::memcpy(first + 3 * column, &sum, 3 * sizeof(float));
        if (++column == columns) {
            column = 0;
            first += row_floats;
        }
    }
}

}  // namespace relume::view
