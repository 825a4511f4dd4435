// Radiances of the vertices that a camera sees, while light, camera and materials change.
//
// Every integral is made from nothing, over the open texels of a vertex. So it is exact as soon
// as it is made, and depends on nothing that was edited before. What takes time is that there
// are many: while an edit is followed, some vertices still show what was before it. After every
// edit they are drawn anew in a random order, so that those which are made are a fair sample of
// those which are not, and tell how far the image is off; and none waits for ever.
#pragma once

#include "server/triple/finish.h"
#include "server/triple/lit_surface.h"
#include "server/triple/texel_material.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::triple {

// Not thread-safe; advance() spreads its work over the caller's arena.
class TripleSession {
  public:
    // Black, without materials.
    explicit TripleSession(std::shared_ptr<const LitSurface> surface);

    // Radiance of 6·n² texels, in the order of cubemap.h. Throws std::invalid_argument for
    // another size.
    void set_light(const std::array<std::span<const float>, 3>& texels);
    // In place of what the material was. Vertices of a material that was never set are black.
    // Throws std::invalid_argument where the surface has no such material or the finish another
    // resolution.
    void set_material(std::uint32_t material, Finish finish);
    // Where the camera stands, in the frame of the mesh, and the vertices that it sees, each
    // once, with how much each counts in the stated error; all alike where no weights are given.
    // Throws std::invalid_argument for a vertex that is not there and for another number of
    // weights.
    void set_view(const Imath::V3f& eye,
                  std::span<const std::uint32_t> seen,
                  std::span<const float> weights = {});

    // Makes up to so many integrals, or as many as end about when the time is over, at least
    // one run of them; false where nothing was left to do.
    bool advance_by(std::size_t vertices);
    bool advance(double milliseconds);

    // Whether all that is seen is as light, camera and materials are.
    [[nodiscard]] bool exact() const { return first_stale_ == stale_.size(); }
    // Of seen vertices.
    [[nodiscard]] std::size_t stale_count() const { return stale_.size() - first_stale_; }
    // Relative L2 of the vertices seen, as estimated from those made since the edit; 1 where
    // none has been made yet, 0 where exact.
    [[nodiscard]] double stated_error() const;
    // Squared length of what is shown at the vertices seen, by their weights.
    [[nodiscard]] double squared_norm() const { return norm_ + made_norm_; }
    // [vertices]; of those that were never seen 0.
    [[nodiscard]] std::span<const Radiance> radiance() const { return radiance_; }

  private:
    [[nodiscard]] Radiance integrate(std::uint32_t vertex) const;
    template <typename IsStale>
    void make_stale(const IsStale& is_stale);
    void begin_estimate();

    const std::shared_ptr<const LitSurface> surface_;
    std::array<std::vector<float>, 3> light_;  // in squares
    std::vector<Finish> materials_;
    Imath::V3f eye_{0, 0, 0};
    std::vector<std::uint32_t> seen_;
    std::vector<float> weights_;        // [vertices], of those seen
    std::vector<bool> is_stale_;        // [vertices], seen or not
    std::vector<std::uint32_t> stale_;  // seen ones; those before first_stale_ are made
    std::uint64_t random_ = 0;          // where the random numbers are
    std::size_t first_stale_ = 0;
    std::vector<Radiance> radiance_;
    double squared_change_ = 0;  // of those made since the edit
    double norm_ = 0;            // squared, of all seen, as it stood at the edit
    double made_norm_ = 0;       // of those made, as they are now, less as they were
    double seconds_per_vertex_ = 2e-5;
};

}  // namespace relume::triple
