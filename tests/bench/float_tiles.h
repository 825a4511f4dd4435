// Tiles of a scene's transport before quantisation: what two quantisers can be compared on.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/blocks/block_rows.h"
#include "precompute/bake/blocks/pilot.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace relume::bench {

// The lights errors are measured under (precompute/bake/blocks/light_model.h), kind by kind.
struct TestLights {
    static constexpr std::size_t kKinds = 2;  // natural, sun
    static constexpr std::size_t kPerKind = 4;
    static constexpr std::size_t kCount = kKinds * kPerKind;

    explicit TestLights(std::uint32_t face_resolution);

    std::array<std::vector<float>, kCount> coefficients;
};
// Of a pixel under each light, in red, green and blue.
using LitPixel = std::array<std::array<double, 3>, TestLights::kCount>;

// 16×16 pixels as the bake has them before it quantises.
struct FloatTile {
    struct Pixel {
        bool covered = false;  // by the scene; else it has no row
        std::array<float, 3> tint{1, 1, 1};
        LitPixel exact{};
    };
    bake::BlockRows rows;
    std::vector<Pixel> pixels;  // [256], by slot
};

struct FloatTiles {
    bake::Quantisation quantisation;  // as the bake plans it for the whole image
    std::vector<FloatTile> tiles;
};

// `rows`×`columns` tiles spread evenly over the image of a built-in scene, direct and indirect
// light computed as the bake does. 25 MB a tile and channel at 6×64×64.
[[nodiscard]] FloatTiles sample_tiles(std::string_view builtin_scene,
                                      const bake::BakeParameters& parameters,
                                      const TestLights& lights,
                                      std::uint32_t rows,
                                      std::uint32_t columns);

}  // namespace relume::bench
