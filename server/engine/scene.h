// What all sessions of one scene share: the mapped transport and what follows from it.
#pragma once

#include "protocol/transport/transport.h"
#include "protocol/wire/session_state.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::engine {

// Immutable; safe to share between threads.
class Scene {
  public:
    explicit Scene(std::shared_ptr<const transport::Transport> transport);

    [[nodiscard]] const transport::Transport& transport() const { return *transport_; }
    [[nodiscard]] const transport::TileGrid& image() const {
        return transport_->manifest().image;
    }
    [[nodiscard]] std::uint32_t face_resolution() const {
        return transport_->manifest().face_resolution;
    }
    // Coefficients, N = 6·n².
    [[nodiscard]] std::size_t coefficient_count() const { return bands_.size(); }
    [[nodiscard]] std::uint32_t block_count() const {
        return transport_->manifest().block_count();
    }
    // Floats of one image of sums: [blocks][3][256].
    [[nodiscard]] std::size_t sum_count() const;
    [[nodiscard]] std::uint32_t band_count() const { return band_count_; }
    // Band of every coefficient, [N].
    [[nodiscard]] std::span<const std::uint8_t> bands() const { return bands_; }

    // What a coefficient's change is multiplied with, per colour, to rank it: [3][N], planar.
    //   none       1                                             [Ng03 §4.1, unweighted]
    //   area       2^-level, the amplitude·area of the wavelet    [Ng03 §4.1, area-weighted]
    //   transport  ‖T_j‖ of the colour                           [Ng03 §4.1,
    //   transport-weighted]
    [[nodiscard]] std::span<const float> weights(wire::Priority priority) const {
        return weights_[static_cast<std::size_t>(priority)];
    }

  private:
    std::shared_ptr<const transport::Transport> transport_;
    std::uint32_t band_count_;
    std::vector<std::uint8_t> bands_;
    std::vector<float> weights_[3];
};

}  // namespace relume::engine
