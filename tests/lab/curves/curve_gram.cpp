#include "tests/lab/curves/curve_gram.h"

#include "protocol/basis/curve_basis.h"
#include "protocol/basis/daubechies4.h"
#include "protocol/transport/cell.h"

#include <tbb/parallel_for_each.h>

#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace relume::lab {
namespace {

using transport::kBlockSize;

constexpr Eigen::Index kSize = basis::kDaubechies4Size;

// Columns of one colour, a row a receiver of the shard.
using Columns = std::array<Eigen::MatrixXf, 3>;

Columns decoded(const transport::Transport& transport,
                const transport::ShardReader& shard,
                std::size_t first_column) {
    const transport::ColourModel& colour = transport.manifest().colour;
    Columns columns;
    for (Eigen::MatrixXf& plane : columns) {
        plane.setZero(static_cast<Eigen::Index>(shard.block_count() * kBlockSize), kSize);
    }
    transport::DecodedCell values;
    for (Eigen::Index j = 0; j < kSize; ++j) {
        const std::size_t column = first_column + static_cast<std::size_t>(j);
        for (std::uint32_t k = 0; k < colour.channels; ++k) {
            const transport::SegmentView segment = shard.segment(column, k);
            if (segment.empty()) {
                continue;
            }
            const std::uint8_t* cell = segment.cells;
            for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
                cell = transport::decode_cell(segment.tag(block), cell, values);
                for (std::size_t c = 0; c < 3; ++c) {
                    const float factor = colour.matrix[c][k] * transport.step(column, k);
                    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                        columns[c](static_cast<Eigen::Index>(block * kBlockSize + slot), j) +=
                            factor * static_cast<float>(values[slot]);
                    }
                }
            }
        }
    }
    return columns;
}

// W with W·samples = coefficients.
Eigen::MatrixXd wavelet_matrix() {
    Eigen::MatrixXd matrix(kSize, kSize);
    std::array<float, kSize> column{};
    for (Eigen::Index j = 0; j < kSize; ++j) {
        column.fill(0);
        column[static_cast<std::size_t>(j)] = 1;
        basis::daubechies4_forward(column, column);
        for (Eigen::Index i = 0; i < kSize; ++i) {
            matrix(i, j) = double{column[static_cast<std::size_t>(i)]};
        }
    }
    return matrix;
}

}  // namespace

double CurveGram::squared_norm(const std::array<Eigen::VectorXd, 3>& change) const {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        sum += change[c].dot(of_samples[c] * change[c]);
    }
    return std::max(sum, 0.0);
}

CurveGram curve_gram(const transport::Transport& transport, std::uint32_t material) {
    const std::size_t first =
        transport.manifest().signal_basis.curves().first_coefficient(material) + 1;
    std::array<Eigen::MatrixXd, 3> of_coefficients;
    of_coefficients.fill(Eigen::MatrixXd::Zero(kSize, kSize));
    std::mutex mutex;
    const std::span<const transport::ShardReader> shards = transport.shards();
    tbb::parallel_for_each(shards.begin(), shards.end(), [&](const auto& shard) {
        const Columns columns = decoded(transport, shard, first);
        for (std::size_t c = 0; c < 3; ++c) {
            const Eigen::MatrixXd product =
                (columns[c].transpose() * columns[c]).template cast<double>();
            const std::scoped_lock lock(mutex);
            of_coefficients[c] += product;
        }
    });
    const Eigen::MatrixXd wavelets = wavelet_matrix();
    CurveGram gram;
    for (std::size_t c = 0; c < 3; ++c) {
        gram.of_samples[c] = wavelets.transpose() * of_coefficients[c] * wavelets;
    }
    return gram;
}

}  // namespace relume::lab
