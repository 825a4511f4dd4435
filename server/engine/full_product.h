// The dense product T·L of the stored transport, made from nothing in slices of a budget, aside
// from the image being shown.
#pragma once

#include "server/engine/band_images.h"
#include "server/engine/scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace relume::engine {

// Sums run in the order of bands and columns whatever came before and whoever is swept with it,
// so the result depends on the lighting alone. Not thread-safe.
class FullProduct {
  public:
    explicit FullProduct(const Scene& scene) : scene_(&scene) {}

    [[nodiscard]] bool running() const { return blocks_left_ > 0; }
    // Begins anew with this lighting, planar [3][N], at any block: it goes around. Products
    // that stand at the same block are swept together.
    void start(std::span<const float> lighting, std::uint32_t first_block = 0);
    void abandon();
    [[nodiscard]] std::uint32_t next_block() const { return next_block_; }

    // Each of the products, all running and of one scene, goes through some blocks, and
    // on until about `bytes` of strips have been read; returns the bytes read, those that
    // several shared counted for each. One ends with running() false when all is done.
    static std::uint64_t advance_together(std::span<FullProduct* const> products,
                                          std::uint64_t bytes);
    std::uint64_t advance(std::uint64_t bytes) {
        FullProduct* const product = this;
        return advance_together({&product, 1}, bytes);
    }

    // Hands the finished images over in exchange for the ones given.
    void exchange(BandImages& images);

  private:
    // All of them stand at the same block.
    static std::uint64_t sweep(std::span<FullProduct* const> products, std::uint64_t bytes);

    const Scene* scene_;
    std::unique_ptr<BandImages> images_;  // borrowed while it runs
    ColumnWeights weights_;
    std::uint32_t next_block_ = 0;
    std::uint32_t blocks_left_ = 0;
};

}  // namespace relume::engine
