// The basis in which the light of a transport is written: Haar wavelets or spherical harmonics.
#pragma once

#include "protocol/basis/bands.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/spherical_harmonics.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::basis {

static_assert(kMaxShOrder <= kMaxBands);

// A value: kind, order and resolution, and the counts and bands that follow from them.
// cubemap_projection.h goes from texels to coefficients.
class CubemapBasis {
  public:
    enum class Kind : std::uint8_t {
        haar,                // haar.h: 6·n² coefficients, a band a level
        spherical_harmonics  // spherical_harmonics.h: order² coefficients, a band an l
    };

    // Light comes as a cubemap of resolution n in either kind. Throws std::invalid_argument
    // unless is_face_resolution(n) and 1 ≤ order ≤ kMaxShOrder.
    [[nodiscard]] static CubemapBasis haar(std::uint32_t face_resolution);
    [[nodiscard]] static CubemapBasis spherical_harmonics(std::uint32_t order,
                                                          std::uint32_t face_resolution);
    // Haar of the smallest cubemap.
    CubemapBasis() = default;

    [[nodiscard]] Kind kind() const { return kind_; }
    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    // Of spherical harmonics; 0 for Haar.
    [[nodiscard]] std::uint32_t order() const { return order_; }

    [[nodiscard]] std::size_t coefficient_count() const;
    [[nodiscard]] std::uint32_t band_count() const;
    // In [0, band_count). For spherical harmonics it never falls as the index rises.
    [[nodiscard]] std::uint32_t band_from_coefficient(std::size_t coefficient) const;
    // log₂ of the band's angular frequency, relative to that of band 0. What falls off as a
    // power of frequency falls off exponentially with the octave.
    [[nodiscard]] float octave_from_band(std::uint32_t band) const;

    [[nodiscard]] Bands bands() const;

    // Radiance 1 from everywhere: its coefficients that are not zero, by index.
    struct Term {
        std::uint32_t coefficient = 0;
        float value = 0;
    };
    [[nodiscard]] std::vector<Term> constant_light() const;

    friend bool operator==(const CubemapBasis&, const CubemapBasis&) = default;

  private:
    CubemapBasis(Kind kind, std::uint32_t face_resolution, std::uint32_t order);

    Kind kind_ = Kind::haar;
    std::uint32_t face_resolution_ = kMinFaceResolution;
    std::uint32_t order_ = 0;
};

}  // namespace relume::basis
