// Looks into the scenes under tests/cases: what their surfaces are at a place of the picture.
#pragma once

#include "precompute/scene/import.h"
#include "precompute/scene/surface_point.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relume::test {

// `name` as "01-percent-encoded-uris/plain.gltf".
[[nodiscard]] std::filesystem::path case_path(const std::string& name);
[[nodiscard]] scene::Scene import_case(const std::string& name);

// In the world of the file.
[[nodiscard]] Imath::V3f world_position(const scene::Scene& scene,
                                        std::size_t mesh,
                                        std::size_t vertex);

// The nearest surface that a ray along −Z through (x, y) meets from far out; nothing where it
// meets none. Passes holes.
[[nodiscard]] std::optional<scene::SurfacePoint> surface_at(const scene::Scene& scene,
                                                            float x,
                                                            float y);
// Its diffuse colour; (−1, −1, −1) where there is none.
[[nodiscard]] Imath::V3f colour_at(const scene::Scene& scene, float x, float y);

// Fails the test unless the quad shows red, green (above), blue and yellow (below).
void expect_quadrants(const scene::Scene& scene);

[[nodiscard]] bool mentions(const std::vector<std::string>& lines, const std::string& word);

}  // namespace relume::test
