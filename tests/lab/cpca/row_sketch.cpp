#include "tests/lab/cpca/row_sketch.h"

#include "protocol/transport/hash.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace relume::lab {

RowVectors sketch_rows(const VertexRows& rows,
                       float falloff,
                       std::size_t numbers,
                       std::uint64_t seed) {
    const std::size_t columns = rows.columns();
    const std::uint32_t planes = *std::max_element(rows.planes.begin(), rows.planes.end());
    std::vector<std::uint32_t> number(planes * columns);
    std::vector<float> factor(planes * columns);
    for (std::size_t i = 0; i < number.size(); ++i) {
        const std::uint64_t bits = transport::mix_bits(transport::mix_bits(seed) + i);
        const float octave =
            rows.basis.octave_from_band(rows.basis.band_from_coefficient(i % columns));
        number[i] = static_cast<std::uint32_t>((bits >> 1U) % numbers);
        factor[i] = std::exp2(-falloff * octave) * ((bits & 1U) != 0 ? 1.0F : -1.0F);
    }
    RowVectors sketches = RowVectors::Zero(static_cast<Eigen::Index>(rows.vertex_count()),
                                           static_cast<Eigen::Index>(numbers));
    tbb::parallel_for(std::size_t{0}, rows.vertex_count(), [&](std::size_t v) {
        float* sketch = sketches.row(static_cast<Eigen::Index>(v)).data();
        const std::span<const float> row = rows.row(v);
        for (std::size_t i = 0; i < row.size(); ++i) {
            sketch[number[i]] += factor[i] * row[i];
        }
    });
    return sketches;
}

}  // namespace relume::lab
