// A lighting as the sketch of the transport sees it: S·T·L, band by band.
#pragma once

#include "server/engine/plan.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// [bands][3][rows] numbers. Updates are added in double precision, so that a light of 10⁵ that
// came and went leaves nothing behind. Not thread-safe.
class BandSketches {
  public:
    BandSketches(const Scene& scene, const transport::Sketch& sketch);

    // From lighting, planar [3][N]: one pass over the sketch, spread over the caller's arena
    // with a result that does not depend on it.
    void set(std::span<const float> lighting);
    // The same without what does not count: columns that each have so little of the image's
    // energy, Σ_c (L(c,j)·‖T(c,j)‖)², that all together would leave no more than 10⁻⁴ of its
    // norm were they orthogonal. Most of a light's columns are such.
    void set_nearly(std::span<const float> lighting);
    // The lighting has changed in this way.
    void apply(const Plan& plan);

    // [3][rows].
    [[nodiscard]] std::span<const double> band(std::uint32_t band) const {
        return std::span(bands_).subspan(band * size_, size_);
    }
    // 3·rows, and row r of all bands together.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] double sum(std::size_t r) const;

  private:
    template <typename Counts>
    void add_all(std::span<const float> lighting, const Counts& counts);
    // (L(c,j)·‖T(c,j)‖)², of all columns and of one.
    [[nodiscard]] double energy_of(std::span<const float> lighting);
    [[nodiscard]] double energy_of(std::span<const float> lighting,
                                   std::size_t column,
                                   std::uint32_t colour) const;

    const Scene* scene_;
    const transport::Sketch* sketch_;
    std::size_t size_;           // 3·rows
    std::vector<double> bands_;  // [bands][3][rows]
    std::vector<float>
        partial_;  // [chunks][3][rows], kept so that the next pass need not allocate
    std::vector<double> energies_;  // [chunks], as partial_
};

// sums[3][rows] += S·T·ΔL of the changes.
void add_sketch(const transport::Sketch& sketch,
                std::span<const ColumnChange> changes,
                std::span<float> sums);
void add_sketch(const transport::Sketch& sketch,
                std::span<const ColumnChange> changes,
                std::span<double> sums);

}  // namespace relume::engine
