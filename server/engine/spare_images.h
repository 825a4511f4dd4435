// Images that a whole product was made in and that nobody shows any more.
#pragma once

#include "server/engine/band_images.h"

#include <array>
#include <atomic>
#include <memory>

namespace relume::engine {

// A session needs a second set of images only while its product is being made; sets that are
// free go to whoever of the scene begins the next, their memory being at hand. Thread-safe, and
// nobody waits for anybody.
class SpareImages {
  public:
    SpareImages() = default;
    SpareImages(const SpareImages&) = delete;
    SpareImages& operator=(const SpareImages&) = delete;
    ~SpareImages();

    // Whatever they hold: a product sets all of it.
    [[nodiscard]] std::unique_ptr<BandImages> take(const Scene& scene);
    // Keeps as many as are needed together in one sweep, frees the others.
    void give(std::unique_ptr<BandImages> images);

  private:
    std::array<std::atomic<BandImages*>, kMaxBatchMembers> spare_{};  // owned, or null
};

}  // namespace relume::engine
