// What all sessions of one scene share: the mapped transport and what follows from it.
#pragma once

#include "protocol/basis/cubemap_projection.h"
#include "protocol/relighting/strategy.h"
#include "protocol/transport/transport.h"
#include "server/engine/band_chunk.h"
#include "server/engine/strip_matrix.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::engine {

class SpareImages;

// Immutable but for what it lends; safe to share between threads.
class Scene {
  public:
    explicit Scene(std::shared_ptr<const transport::Transport> transport);
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    ~Scene();

    [[nodiscard]] const transport::Transport& transport() const { return *transport_; }
    [[nodiscard]] const transport::TileGrid& image() const {
        return transport_->manifest().image;
    }
    [[nodiscard]] const basis::LightBasis& light_basis() const {
        return transport_->manifest().light_basis;
    }
    // From a cubemap of light of resolution `face_resolution()` to coefficients.
    [[nodiscard]] const basis::CubemapProjection& projection() const { return *projection_; }
    [[nodiscard]] std::uint32_t face_resolution() const {
        return light_basis().face_resolution();
    }
    // Coefficients of the basis, N.
    [[nodiscard]] std::size_t coefficient_count() const { return bands_.size(); }
    [[nodiscard]] std::uint32_t block_count() const {
        return transport_->manifest().block_count();
    }
    // Floats of one image of sums: [blocks][3][256].
    [[nodiscard]] std::size_t sum_count() const;
    [[nodiscard]] std::uint32_t band_count() const { return light_basis().band_count(); }
    // Band of every coefficient, [N].
    [[nodiscard]] std::span<const std::uint8_t> bands() const { return bands_; }

    // All columns, ordered by band and then index: the order in which images are summed, [N].
    [[nodiscard]] std::span<const std::uint32_t> columns_by_band() const {
        return columns_by_band_;
    }
    // Those of one band, by index.
    [[nodiscard]] std::span<const std::uint32_t> columns_of_band(std::uint32_t band) const {
        return std::span(columns_by_band_)
            .subspan(band_begins_[band], band_begins_[band + 1] - band_begins_[band]);
    }
    // Every place in it, 0 … N−1.
    [[nodiscard]] std::span<const std::uint32_t> places() const { return places_; }
    // The same in pieces of one band and at most 1024 columns, in order: what loops over the
    // lighting are parallel over, so that their sums do not depend on the number of threads.
    [[nodiscard]] std::span<const BandChunk> band_chunks() const { return band_chunks_; }

    // The transport arranged for whole products.
    [[nodiscard]] const StripMatrix& strips() const { return *strips_; }
    // Where sessions borrow the images that they make whole products in.
    [[nodiscard]] SpareImages& spare_images() const { return *spare_images_; }
    // Bytes of memory: the mapped transport and the strips.
    [[nodiscard]] std::uint64_t bytes() const {
        return transport_->total_bytes() + strips_->bytes();
    }

    // What a coefficient's change is multiplied with, per colour, to rank it: [3][N], planar.
    //   none       1                                             [Ng03 §4.1, unweighted]
    //   area       2^−octave of the band: a wavelet's amplitude·area [Ng03 §4.1,
    //              area-weighted]; for spherical harmonics the inverse of the tolerance, README
    //   transport  ‖T_j‖ of the colour                    [Ng03 §4.1, transport-weighted]
    //   benefit    ‖T_j‖ / √(bytes of the column): squared, what the image gains per byte read
    [[nodiscard]] std::span<const float> weights(relighting::Priority priority) const {
        return weights_[static_cast<std::size_t>(priority)];
    }

  private:
    void order_by_band();

    std::shared_ptr<const transport::Transport> transport_;
    std::shared_ptr<const basis::CubemapProjection> projection_;
    std::vector<std::uint8_t> bands_;
    std::vector<std::uint32_t> columns_by_band_;
    std::vector<std::size_t> band_begins_;  // [bands + 1], places in columns_by_band_
    std::vector<std::uint32_t> places_;
    std::vector<BandChunk> band_chunks_;
    std::array<std::vector<float>, 4> weights_;
    std::unique_ptr<const StripMatrix> strips_;
    std::unique_ptr<SpareImages> spare_images_;
};

}  // namespace relume::engine
