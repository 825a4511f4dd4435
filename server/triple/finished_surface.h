// The parts of a surface that are given finishes, as one room sees them.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "server/triple/finish.h"
#include "server/triple/triple_session.h"
#include "server/view/mesh/given_radiance.h"
#include "server/view/view.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>

namespace relume::triple {

// Not thread-safe; advance() spreads its work over the caller's arena.
class FinishedSurface final : public view::GivenRadiance {
  public:
    using Finishes = std::map<std::uint32_t, Finish>;  // by the number of the material

    // Without finishes, under no light.
    explicit FinishedSurface(std::shared_ptr<const LitSurface> surface)
        : session_(std::move(surface)) {}

    [[nodiscard]] const Finishes& finishes() const { return finishes_; }
    // In place of those before. Throws std::invalid_argument for a finish of another resolution
    // than the surface's, and for a material that the surface does not have.
    void set_finishes(Finishes finishes);
    // Throws std::invalid_argument for another resolution.
    void set_light(const light::LightCubemap& cubemap);
    // What the view sees of the parts that have finishes, and from where, in the frame of the
    // mesh.
    void set_view(const Imath::V3f& eye, const view::SeenVertices& seen);

    // Works for about so long; true where radiances have changed.
    bool advance(double milliseconds);
    // Whether all that is seen is as light, camera and finishes are.
    [[nodiscard]] bool exact() const { return session_.exact(); }
    [[nodiscard]] std::size_t stale_count() const { return session_.stale_count(); }
    // Relative L2 of the pixels of these parts, as TripleSession estimates it.
    [[nodiscard]] double stated_error() const { return session_.stated_error(); }
    // Milliseconds of work since light, camera or finishes changed.
    [[nodiscard]] double worked_milliseconds() const { return worked_milliseconds_; }

    [[nodiscard]] bool is_given(std::uint32_t material) const override {
        return finishes_.contains(material);
    }
    [[nodiscard]] std::span<const Radiance> radiance() const override {
        return session_.radiance();
    }
    [[nodiscard]] std::uint64_t materials_version() const override {
        return materials_version_;
    }
    [[nodiscard]] std::uint64_t radiance_version() const override { return radiance_version_; }

  private:
    TripleSession session_;
    Finishes finishes_;
    std::uint64_t materials_version_ = 0;
    std::uint64_t radiance_version_ = 0;
    double worked_milliseconds_ = 0;
};

}  // namespace relume::triple
