// The dense product T·L of the stored transport, made from nothing in slices of a budget, aside
// from the image being shown.
#pragma once

#include "server/engine/band_images.h"
#include "server/engine/column_change.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Sums run in the order of bands and columns whatever came before, so the result depends on the
// lighting alone. Not thread-safe.
class FullProduct {
  public:
    explicit FullProduct(const Scene& scene) : scene_(&scene) {}

    [[nodiscard]] bool running() const { return running_; }
    // Begins anew with this lighting, planar [3][N].
    void start(std::span<const float> lighting);
    void abandon() { running_ = false; }

    // Goes through at least one shard, and on until about `bytes` of columns have been read;
    // returns the bytes read. Ends with running() false when all is done.
    std::uint64_t advance(std::uint64_t bytes);

    // Hands the finished images over in exchange for the ones given.
    void exchange(BandImages& images);

  private:
    const Scene* scene_;
    std::vector<BandImages> images_;  // none until first needed, then one
    std::vector<ColumnChange> columns_;
    std::size_t next_shard_ = 0;
    bool running_ = false;
};

}  // namespace relume::engine
