#include "protocol/basis/cubemap.h"
#include "protocol/tripling/triple_integral.h"
#include "protocol/tripling/wavelet_square.h"
#include "server/engine/kernels/triple_product.h"

namespace relume::engine {

LightTable::LightTable(std::uint32_t n) : n_(n), rows_(16 * tripling::square_stride(n), 0) {}

void LightTable::set(const std::array<std::span<const float>, 3>& coefficients) {
    const std::size_t face_size = std::size_t{n_} * n_;
    std::vector<float> means(tripling::square_count(n_));
    for (std::size_t colour = 0; colour < coefficients.size(); ++colour) {
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            const auto of_face = coefficients[colour].subspan(face * face_size, face_size);
            means[0] = of_face[0];
            for (std::size_t i = 0; i < means.size(); ++i) {
                const tripling::WaveletSquare square = tripling::square_from_index(i);
                const auto size = static_cast<float>(tripling::amplitude(n_, square.level));
                const auto wavelets = tripling::square_coefficients(n_, square, of_face);
                float* row = &rows_[16 * (face * tripling::face_stride(n_) + i) + colour];
                row[0] = size * means[i];
                for (std::size_t m = 0; m < wavelets.size(); ++m) {
                    row[4 * (m + 1)] = size * wavelets[m];
                }
                if (tripling::first_child(i) < means.size()) {
                    const auto quarters = tripling::quarter_sums(means[i], wavelets);
                    for (std::size_t quadrant = 0; quadrant < quarters.size(); ++quadrant) {
                        means[tripling::first_child(i) + quadrant] = 0.5F * quarters[quadrant];
                    }
                }
            }
        }
    }
}

}  // namespace relume::engine
