// Error against time of triple products, factored BRDFs and clustered PCA at the vertices of
// one surface, while the light moves, the view, or both.
#pragma once

#include "precompute/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// Every material of the scene becomes one GGX surface without textures: grey, half a metal.
struct TripleParetoOptions {
    std::string scene = "box";  // built in
    float roughness = 0.5F;
    std::uint32_t vertices = 6'000;  // at most
    std::uint32_t face_resolution = 32;
    std::uint32_t side = 256;  // of images, in pixels
    std::uint32_t terms = 10;  // of the factored BRDF
    std::uint32_t images = 12;
    std::string environment = "studio";
    std::filesystem::path cache;  // where the surface is baked to
};

struct TripleParetoPoint {
    std::string series;       // what does not change along a curve: "factored, K = 4"
    std::string setting;      // "30 columns an image"
    double milliseconds = 0;  // an image, in the median
    double error =
        0;  // relative L2 of the exact integral with the material itself, in the mean
};

struct TripleParetoPanel {
    std::string moving;  // "light", "view", "light and view"
    std::vector<TripleParetoPoint> points;
};

struct TriplePareto {
    std::size_t vertices = 0;
    std::size_t seen = 0;  // by the first camera
    std::vector<TripleParetoPanel> panels;
    double visibility_bytes = 0;  // bits of all vertices
    double material_bytes = 0;    // of the field, back in texels
    double factored_bytes = 0;    // of all terms, as stored
};

// Direct light. Light and camera turn by 1.5° an image, from an image that every method has
// had six steps for. Bits and rows have the same rays: one a texel, shadow edges not sampled
// further. With the threads of the calling arena. Throws as bake::bake does.
[[nodiscard]] TriplePareto measure_triple_pareto(const TripleParetoOptions& options);

}  // namespace relume::lab
