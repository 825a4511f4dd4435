// What a baked view shows when nothing is spared: the picture that bakes are compared with.
#pragma once

#include "precompute/bake/relight.h"
#include "precompute/scene/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace relume::lab {

// Camera positions are a jittered grid over the pixel. Every position sees a surface point of
// its own, from which one ray goes to every texel of the light and its part of the paths
// starts. Two halves are independent of each other; all counts are of a half.
struct ReferenceOptions {
    std::uint32_t width = 96;  // pixels
    std::uint32_t height = 64;
    std::uint32_t face_resolution = 32;
    std::uint32_t bounces = 2;
    std::uint32_t side = 6;        // camera positions along a side of a pixel
    std::uint32_t edge_side = 11;  // the same where surfaces meet in the pixel
    std::uint32_t paths = 2048;    // a pixel, at least one a position
};

struct ReferenceLight {
    std::string name;
    bake::CubemapLight texels;
};

// What is seen in a pixel: nothing; several surfaces, or one and the sky; one that reflects
// sharply; any other.
enum class PixelContent : std::uint8_t { nothing, edge, gloss, matte };

// Pictures are interleaved RGB, 3·width·height values, linear, premultiplied by coverage.
struct LitReference {
    std::array<std::vector<float>, 2> half;
    // By pixel, in [0, 1]: how much it sees of the light's brightest texels, those of a quarter
    // of the brightest's luminance or more, of the part that is above the pixel's surfaces.
    std::vector<float> key_open;

    // The mean of both halves.
    [[nodiscard]] std::vector<float> picture() const;
};

struct BakeReference {
    std::vector<PixelContent> content;  // by pixel
    std::vector<LitReference> lit;      // by light
};

// `on_row` is told how many rows of pixels are done. The same on any number of threads.
[[nodiscard]] BakeReference trace_reference(
    const scene::Scene& scene,
    const std::vector<ReferenceLight>& lights,
    const ReferenceOptions& options,
    const std::function<void(std::uint32_t rows)>& on_row);

}  // namespace relume::lab
