// Both peers with the same columns, and whether they make the images that we make.
#pragma once

#include "tests/bench/eigen_product.h"
#include "tests/bench/light_drag.h"
#include "tests/bench/ng03_product.h"

#include <nlohmann/json_fwd.hpp>

#include <span>

namespace relume::bench {

// Hold the columns that a drag touches, and no others. Immutable.
struct Peers {
    Peers(const served::Scene& scene,
          std::span<const ChangesOfImage> images,
          PeerBasis basis,
          float levels = kNg03Levels)
        : columns(scene, columns_of(images), basis, levels), eigen(columns), ng03(columns) {}

    SparseColumns columns;
    EigenColumns eigen;
    Ng03Columns ng03;
};

// How much each peer holds.
[[nodiscard]] nlohmann::json to_json(const Peers& peers);

// Makes the images of a drag by the engine and by each peer, and returns by how much each last
// one differs from ours: ‖peer − ours‖/‖ours‖ in the basis of the peers, before tint. Throws
// std::runtime_error when it is more than `allowed`.
[[nodiscard]] nlohmann::json checked_differences(const Peers& peers,
                                                 std::span<const ChangesOfImage> images,
                                                 double allowed);

}  // namespace relume::bench
