// Indirect light of a receiver from its own paths and those of neighbours that see much the
// same.
//
// A neighbour's paths count by its distance in steps, in the plane of the surface, in
// orientation and, for glossy surfaces, in the direction of the mirror image; only surfaces of
// one material are pooled. Near other surfaces indirect light changes fast, so there the pool
// narrows with the harmonic mean distance to what is around [Ward88]. Weights depend on the
// geometry alone, never on what the paths found: pooling blurs, it does not skew.
#pragma once

#include "precompute/bake/rows/escape_sum.h"
#include "precompute/bake/rows/traced_receivers.h"

#include <cstdint>
#include <span>

namespace relume::bake {

// Adds `weight` times the mean of the paths, as seen by the surface `own`, to as many sums as
// PathPool::gather takes.
void add_paths(const ReceiverSurface& own,
               const SurfacePaths& paths,
               float weight,
               std::span<EscapeSum> escapes);

class PathPool {
  public:
    explicit PathPool(const TracedReceivers& traced) : traced_(traced) {}

    // Adds the pooled paths of one surface of the receiver, without its reflectance: to one
    // sum, or, where the surface has a factored BRDF, to one for each term k, each path times
    // π·g_k of the direction in which it leaves. The receiver and its neighbours are in reach.
    // Thread-safe for different sums.
    void gather(std::size_t receiver,
                std::uint32_t surface,
                std::span<EscapeSum> escapes) const;

  private:
    const TracedReceivers& traced_;
};

}  // namespace relume::bake
