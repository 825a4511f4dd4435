// An environment: radiance from every direction, at the full resolution of its source.
#pragma once

#include "protocol/light/lat_long_kernel.h"
#include "protocol/light/map_centre.h"
#include "protocol/light/projection.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::light {

struct LookPoints;

inline constexpr std::uint32_t kMaxMapSide = 16384;
inline constexpr std::size_t kMaxMapTexels = std::size_t{16384} * 8192;
// Brighter texels would overflow the sums of the relighting that follows.
inline constexpr float kMaxTexelRadiance = 1e10F;

// The image as its projection lays it out: linear, Rec. 709, RGB interleaved, row-major from
// the top left, 3·width·height values.
struct MapImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> rgb;
};

// Immutable once made; any number of threads may read it.
class EnvironmentMap {
  public:
    // How the texels are kept: crosses and strips become the six faces of protocol/README.md §1
    // stacked from top to bottom, so that nothing below needs to know where a face lay.
    enum class Layout : std::uint8_t { lat_long, angular, cube_faces };

    // One level of the pyramid. Level 0 holds the source's texels, each next one has half the
    // side and the same energy. `width` and `height` count one face where the layout has faces.
    struct Level {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<float> rgb;
    };

    // Throws EnvironmentError when the shape does not fit the projection, the bounds above are
    // passed, or a value is negative, not finite or above kMaxTexelRadiance.
    EnvironmentMap(MapImage image,
                   Projection projection,
                   MapCentre centre = MapCentre::negative_z);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] Projection projection() const { return projection_; }
    [[nodiscard]] MapCentre centre() const { return centre_; }
    [[nodiscard]] Layout layout() const { return layout_; }
    [[nodiscard]] std::span<const Level> levels() const { return levels_; }

    // Mean radiance around a source direction (any non-zero length), for what is seen directly.
    // `footprint_sr` is the solid angle of the pixel that asks; 0 gives the bilinear lookup at
    // full resolution.
    [[nodiscard]] Imath::V3f radiance(const Imath::V3f& source_direction,
                                      float footprint_sr = 0) const;

    // The same for up to kLooksPerRun directions; as many footprints and results.
    void radiances(const LookDirections& source_directions,
                   std::span<const float> footprints_sr,
                   std::span<Imath::V3f> radiances) const;

    // ∫ radiance dω over the sphere, texel by texel (watts per m² and π of a point, if you
    // like: 4π for a constant map of 1). For exposure and for tests of energy.
    [[nodiscard]] Imath::V3d total_energy() const;

  private:
    [[nodiscard]] LookDirections turned(const LookDirections& source_directions) const;
    void find_points(const LookDirections& source_directions,
                     std::span<const float> footprints_sr,
                     LookPoints& points) const;
    // Of one level: its share of what is seen, by weight.
    void add_level(const Level& level,
                   const LookPoints& points,
                   const LookNumbers& weights,
                   std::span<Imath::V3f> radiances) const;

    std::uint32_t width_;
    std::uint32_t height_;
    Projection projection_;
    MapCentre centre_;
    Layout layout_;
    std::vector<Level> levels_;
};

}  // namespace relume::light
