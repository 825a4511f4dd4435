// Images that a whole product was made in and that nobody shows any more.
#pragma once

#include "server/engine/band_images.h"

#include <mutex>
#include <vector>

namespace relume::engine {

// A session needs a second set of images only while its product is being made; sets that are
// free go to whoever of the scene begins the next, their memory being at hand. Thread-safe.
class SpareImages {
  public:
    SpareImages();

    // Whatever they hold: a product sets all of it.
    [[nodiscard]] BandImages take(const Scene& scene);
    // Keeps as many as are needed together in one sweep, frees the others.
    void give(BandImages&& images);

  private:
    std::mutex mutex_;
    std::vector<BandImages> spare_;
};

}  // namespace relume::engine
