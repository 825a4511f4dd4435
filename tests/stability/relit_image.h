// Relit images and the distances between them.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "server/scene/scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::stability {

// Interleaved RGB, row by row from the top, linear radiance.
struct RelitImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> rgb;
};

[[nodiscard]] RelitImage image_of(const served::Scene& scene, const engine::Session& session);

// Euclidean, over all pixels and colours.
[[nodiscard]] double norm(const RelitImage& image);
[[nodiscard]] double distance(const RelitImage& a, const RelitImage& b);
// ‖(a1 − b1) − (a0 − b0)‖: how much the error of a changes from one image to the next.
[[nodiscard]] double error_change(const RelitImage& a0,
                                  const RelitImage& b0,
                                  const RelitImage& a1,
                                  const RelitImage& b1);
// |a − b|, times `gain`.
[[nodiscard]] RelitImage absolute_difference(const RelitImage& a,
                                             const RelitImage& b,
                                             float gain);

using Lighting = std::vector<float>;  // Haar coefficients of radiance, planar [3][N]

// What a method shows under one lighting after the other, one step each.
struct RelitRun {
    std::vector<RelitImage> images;
    std::vector<engine::StepReport> steps;
    std::vector<Lighting> approximations;  // L̃ after each step
};
[[nodiscard]] RelitRun relight_in_turn(const std::shared_ptr<const served::Scene>& scene,
                                       relighting::Strategy strategy,
                                       std::uint32_t columns,
                                       std::span<const Lighting> lightings);

// The exact image of every lighting: the dense product of the stored transport.
[[nodiscard]] std::vector<RelitImage> exact_images(
    const std::shared_ptr<const served::Scene>& scene, std::span<const Lighting> lightings);
// Advances until exact.
void run_until_exact(engine::Session& session);

}  // namespace relume::stability
