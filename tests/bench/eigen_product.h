// The peer everybody has: Eigen's sparse matrix of floats, as strong as it gets.
#pragma once

#include "tests/bench/sparse_columns.h"

#include <memory>
#include <string_view>
#include <vector>

namespace relume::bench {

// How the image of the product lies in memory; which is fastest is found out by trying.
enum class EigenLayout {
    planar,       // column-major rows×3: Eigen goes over the columns once for each colour
    interleaved,  // row-major rows×3: once for all colours
    padded,       // row-major rows×4: as that, a vector instruction per non-zero
};
inline constexpr EigenLayout kEigenLayouts[] = {EigenLayout::planar, EigenLayout::interleaved,
                                                EigenLayout::padded};
[[nodiscard]] std::string_view name_from(EigenLayout layout);

// The chosen columns as column-major SparseMatrix<float>, one per shard: each fits its rows of
// the image into the second-level cache, and shards are spread over threads (Eigen itself runs
// this product on one). Immutable.
class EigenColumns {
  public:
    // Keeps a reference. Holds values as they were before they were rounded, but only those
    // that the rounding left: Eigen is not made to multiply what a narrower format drops.
    explicit EigenColumns(const SparseColumns& columns);
    EigenColumns(const EigenColumns&) = delete;
    EigenColumns& operator=(const EigenColumns&) = delete;
    EigenColumns(EigenColumns&&) = delete;
    EigenColumns& operator=(EigenColumns&&) = delete;
    ~EigenColumns();

    [[nodiscard]] std::size_t nonzeros() const;
    // Values, rows and where columns begin.
    [[nodiscard]] std::size_t bytes() const;

  private:
    friend class EigenProduct;
    struct Shards;

    const SparseColumns* columns_;
    std::unique_ptr<Shards> shards_;
};

// An image that changes are added to: B += T_sel·L_sel. T_sel is mapped, not copied: Eigen
// takes a matrix whose columns lie apart. Work is spread over the calling arena. Not
// thread-safe.
class EigenProduct {
  public:
    EigenProduct(const EigenColumns& columns, EigenLayout layout);
    EigenProduct(const EigenProduct&) = delete;
    EigenProduct& operator=(const EigenProduct&) = delete;
    EigenProduct(EigenProduct&&) = delete;
    EigenProduct& operator=(EigenProduct&&) = delete;
    ~EigenProduct();

    void add(std::span<const engine::ColumnChange> changes);
    // [blocks][3][256], in the basis of the columns, before tint.
    [[nodiscard]] std::vector<float> sums() const;

  private:
    struct Image;

    const EigenColumns* columns_;
    std::unique_ptr<Image> image_;
};

}  // namespace relume::bench
