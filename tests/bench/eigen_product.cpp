#include "tests/bench/eigen_product.h"

#include <Eigen/SparseCore>
#include <tbb/parallel_for.h>

#include <variant>

namespace relume::bench {
namespace {

using transport::kBlockSize;
using transport::kColours;
using Columns = Eigen::SparseMatrix<float, Eigen::ColMajor, int>;
using Planar = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::ColMajor>;
using Interleaved = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Padded = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;

Columns shard_columns(const transport::ShardReader& shard, const SparseColumns& columns) {
    const auto rows = static_cast<Eigen::Index>(shard.block_count() * kBlockSize);
    Columns matrix(rows, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t position = 0; position < columns.size(); ++position) {
        const auto column = static_cast<Eigen::Index>(position);
        matrix.startVec(column);
        columns.for_each_entry(shard, position, [&](const SparseEntry& entry) {
            matrix.insertBack(entry.block * kBlockSize + entry.slot, column) = entry.value;
        });
    }
    matrix.finalize();
    matrix.data().squeeze();
    return matrix;
}

template <typename Image>
std::vector<Image> black(const served::Scene& scene) {
    std::vector<Image> shards;
    for (const auto& shard : scene.transport().shards()) {
        shards.push_back(
            Image::Zero(shard.block_count() * kBlockSize, Image::ColsAtCompileTime));
    }
    return shards;
}

// Which columns of a matrix, and where they are.
struct ColumnChoice {
    std::vector<std::size_t> positions;
    std::vector<std::array<float, kColours>> weights;
};

template <typename Image>
void add_columns(const Columns& matrix, const ColumnChoice& choice, Image& image) {
    thread_local std::vector<int> begins;
    thread_local std::vector<int> counts;
    begins.clear();
    counts.clear();
    for (const std::size_t position : choice.positions) {
        const int begin = matrix.outerIndexPtr()[position];
        begins.push_back(begin);
        counts.push_back(matrix.outerIndexPtr()[position + 1] - begin);
    }
    begins.push_back(0);  // the end of the last one, which counts make superfluous
    const auto chosen = static_cast<Eigen::Index>(choice.positions.size());
    const Eigen::Map<const Columns> columns(matrix.rows(), chosen, matrix.nonZeros(),
                                            begins.data(), matrix.innerIndexPtr(),
                                            matrix.valuePtr(), counts.data());
    Image weights = Image::Zero(chosen, Image::ColsAtCompileTime);
    for (Eigen::Index i = 0; i < chosen; ++i) {
        for (std::size_t c = 0; c < kColours; ++c) {
            weights(i, static_cast<Eigen::Index>(c)) =
                choice.weights[static_cast<std::size_t>(i)][c];
        }
    }
    image.noalias() += columns * weights;
}

}  // namespace

std::string_view name_from(EigenLayout layout) {
    switch (layout) {
        case EigenLayout::planar:
            return "planar";
        case EigenLayout::interleaved:
            return "interleaved";
        case EigenLayout::padded:
            return "padded";
    }
    return "";
}

struct EigenColumns::Shards {
    std::vector<Columns> matrices;
};

EigenColumns::EigenColumns(const SparseColumns& columns)
    : columns_(&columns), shards_(std::make_unique<Shards>()) {
    const auto& shards = columns.scene().transport().shards();
    shards_->matrices.resize(shards.size());
    tbb::parallel_for(std::size_t{0}, shards.size(), [&](std::size_t shard) {
        shards_->matrices[shard] = shard_columns(shards[shard], columns);
    });
}

EigenColumns::~EigenColumns() = default;

std::size_t EigenColumns::nonzeros() const {
    Eigen::Index count = 0;
    for (const Columns& matrix : shards_->matrices) {
        count += matrix.nonZeros();
    }
    return static_cast<std::size_t>(count);
}

std::size_t EigenColumns::bytes() const {
    const std::size_t begins = shards_->matrices.size() * (columns_->size() + 1);
    return nonzeros() * (sizeof(float) + sizeof(int)) + begins * sizeof(int);
}

struct EigenProduct::Image {
    std::variant<std::vector<Planar>, std::vector<Interleaved>, std::vector<Padded>> shards;
};

EigenProduct::EigenProduct(const EigenColumns& columns, EigenLayout layout)
    : columns_(&columns), image_(std::make_unique<Image>()) {
    switch (layout) {
        case EigenLayout::planar:
            image_->shards = black<Planar>(columns.columns_->scene());
            break;
        case EigenLayout::interleaved:
            image_->shards = black<Interleaved>(columns.columns_->scene());
            break;
        case EigenLayout::padded:
            image_->shards = black<Padded>(columns.columns_->scene());
            break;
    }
}

EigenProduct::~EigenProduct() = default;

void EigenProduct::add(std::span<const engine::ColumnChange> changes) {
    const SparseColumns& index = *columns_->columns_;
    ColumnChoice choice;
    for (const engine::ColumnChange& change : changes) {
        for (std::uint32_t k = 0; k < index.channels(); ++k) {
            choice.positions.push_back(index.position(change.column) + k);
            choice.weights.push_back(channel_weights(index.scene(), change, k));
        }
    }
    std::visit(
        [&](auto& shards) {
            tbb::parallel_for(std::size_t{0}, shards.size(), [&](std::size_t shard) {
                add_columns(columns_->shards_->matrices[shard], choice, shards[shard]);
            });
        },
        image_->shards);
}

std::vector<float> EigenProduct::sums() const {
    std::vector<float> sums;
    sums.reserve(columns_->columns_->scene().stored_operator().sum_count());
    std::visit(
        [&](const auto& shards) {
            for (const auto& image : shards) {
                for (Eigen::Index block = 0; block < image.rows(); block += kBlockSize) {
                    for (std::uint32_t c = 0; c < kColours; ++c) {
                        for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
                            sums.push_back(image(block + slot, c));
                        }
                    }
                }
            }
        },
        image_->shards);
    return sums;
}

}  // namespace relume::bench
