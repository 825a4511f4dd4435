// How much of a small window, placed at some distance from a disc's centre, the disc covers.
//
// Distances are chords of the unit sphere, 2 sin(θ/2): caps of the sphere are then discs of
// exactly their area, and small angles lose no digits as their cosines would.
#pragma once

#include <algorithm>
#include <cmath>

namespace relume::light {

[[nodiscard]] inline float chord_from_angle(float radians) {
    return 2 * std::sin(radians / 2);
}

// 1 inside, 0 outside, falling linearly over a width of `edge` in between; scaled so that the
// integral over the plane is π·radius² whatever the edge. Where the disc is smaller than its
// edge it fades to a cone of the edge's width and lower height.
class DiscCoverage {
  public:
    DiscCoverage(float radius, float edge) : inverse_edge_(1 / edge) {
        // A disc of radius ρ ≥ edge/2 with that edge has the area π(ρ² + edge²/12).
        const float smallest_sq = edge * edge / 3;
        if (radius * radius >= smallest_sq) {
            ramp_radius_ = std::sqrt(radius * radius - edge * edge / 12);
            height_ = 1;
        } else {
            ramp_radius_ = edge / 2;
            height_ = radius * radius / smallest_sq;
        }
    }

    [[nodiscard]] float at(float distance) const {
        return height_ *
               std::clamp((ramp_radius_ - distance) * inverse_edge_ + 0.5F, 0.0F, 1.0F);
    }
    // Full coverage up to here, none from there on.
    [[nodiscard]] float inner_radius() const { return ramp_radius_ - 0.5F / inverse_edge_; }
    [[nodiscard]] float outer_radius() const { return ramp_radius_ + 0.5F / inverse_edge_; }

  private:
    float inverse_edge_;
    float ramp_radius_;
    float height_;
};

}  // namespace relume::light
