#include "protocol/tripling/fourier_tripling.h"

namespace relume::tripling {

double fourier_tripling(std::uint32_t n,
                        const Frequency& u,
                        const Frequency& v,
                        const Frequency& w) {
    const std::int64_t period = n;
    const std::int64_t rows = std::int64_t{u.along_rows} + v.along_rows - w.along_rows;
    const std::int64_t columns =
        std::int64_t{u.along_columns} + v.along_columns - w.along_columns;
    return rows % period == 0 && columns % period == 0 ? 1.0 / static_cast<double>(n) : 0;
}

std::uint64_t fourier_tripling_count(std::uint32_t band_limit) {
    const std::uint64_t m = band_limit;
    const std::uint64_t in_one_dimension = 1 + 3 * m + 3 * m * m;
    return in_one_dimension * in_one_dimension;
}

}  // namespace relume::tripling
