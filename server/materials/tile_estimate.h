// What the pixels of a tile show of an edited material under the present light. A point's light
// is what it sees of the cubemap, by the bits that the bake has stored: no ray is cast, and
// light that other surfaces reflect to it is not in it.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "protocol/sampling/curve_sampler.h"
#include "protocol/sampling/texel_light.h"
#include "server/materials/editable_points.h"
#include "server/materials/light_pyramid.h"
#include "server/materials/tile_columns.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::materials {

// A material as it is shown.
struct ShownMaterial {
    std::size_t material = 0;  // of EditablePoints
    curve::CurveBrdf brdf;     // the specular part with all curves as edited
    Imath::V3f diffuse{1, 1, 1};
    std::size_t taken_up = 0;  // the curve that columns are made of

    // All but the curve that is taken up is as in `other`, so that columns are the same.
    [[nodiscard]] bool has_columns_of(const ShownMaterial& other) const;
    friend bool operator==(const ShownMaterial&, const ShownMaterial&) = default;
};

// A light, as estimates need it. Immutable and thread-safe.
struct PresentLight {
    explicit PresentLight(const light::LightCubemap& cubemap)
        : texels(cubemap), pyramid(cubemap) {}

    sampling::TexelLight texels;
    LightPyramid pyramid;
};

// Pixels of a tile, and by how much each differs from the bake's.
struct TileChange {
    std::vector<std::uint8_t> slots;
    std::vector<float> rgb;  // [pixels][3]
};

// Some of the directions that a tile's columns are estimated from: 21·samples a pixel in all
// (sampling/curve_sampler.h), of which this is one of so many parts.
struct DirectionPart {
    std::uint32_t samples = 1;
    std::uint32_t part = 0;
    std::uint32_t parts = 1;
};

// A tile's columns while directions are added.
struct ColumnSum {
    std::vector<std::uint8_t> slots;  // of the pixels
    ColumnValues values{0};
};

// Immutable and thread-safe; results depend on the arguments alone.
class TileEstimate {
  public:
    // Keeps references to both.
    TileEstimate(const EditablePoints& points, const PresentLight& light)
        : points_(points), light_(light) {}

    // Adds a part of the directions; a sum without pixels gets those of the tile.
    void add_directions(const ShownMaterial& shown,
                        std::uint32_t tile,
                        const DirectionPart& part,
                        ColumnSum& sum) const;
    // A first look, for a material as it is: as few directions as there may be, each for the
    // mean of the light around it, as wide as their density leaves [Krivanek08]. Light and
    // surface are blurred in place of noise; where both are smooth that changes little.
    [[nodiscard]] TileChange glance(const ShownMaterial& shown, std::uint32_t tile) const;

  private:
    const EditablePoints& points_;
    const PresentLight& light_;
};

}  // namespace relume::materials
