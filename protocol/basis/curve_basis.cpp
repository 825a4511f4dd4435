#include "protocol/basis/curve_basis.h"

#include "protocol/basis/daubechies4.h"

#include <bit>
#include <stdexcept>
#include <string>

namespace relume::basis {
namespace {

// The diffuse colour and the wavelets.
constexpr std::size_t kOfOneCurve = 1 + kDaubechies4Size;

}  // namespace

static_assert(1 + kDaubechies4Levels <= kMaxBands);

CurveBasis::CurveBasis(std::uint32_t curve_count) : curve_count_(curve_count) {
    if (curve_count < 1 || curve_count > kMostCurves) {
        throw std::invalid_argument("number of curves is " + std::to_string(curve_count) +
                                    ", expected 1 to " + std::to_string(kMostCurves));
    }
}

std::size_t CurveBasis::coefficient_count() const {
    return first_coefficient(curve_count_);
}

std::uint32_t CurveBasis::band_count() const {
    return 1 + kDaubechies4Levels;
}

std::uint32_t CurveBasis::band_from_coefficient(std::size_t coefficient) const {
    if (coefficient == kRest) {
        return 0;
    }
    const std::size_t of_curve = (coefficient - 1) % kOfOneCurve;
    // 0 is the diffuse colour, 1 the scaling coefficient, 1 + 2^ℓ the first wavelet of level ℓ.
    return of_curve <= 1 ? 0 : static_cast<std::uint32_t>(std::bit_width(of_curve - 1));
}

float CurveBasis::octave_from_band(std::uint32_t band) const {
    return band == 0 ? 0.0F : static_cast<float>(band - 1);
}

Bands CurveBasis::bands() const {
    Bands bands;
    for (std::size_t j = 0; j < coefficient_count(); ++j) {
        bands.of_coefficient.push_back(static_cast<std::uint8_t>(band_from_coefficient(j)));
    }
    for (std::uint32_t band = 0; band < band_count(); ++band) {
        bands.octaves.push_back(octave_from_band(band));
    }
    return bands;
}

std::size_t CurveBasis::first_coefficient(std::uint32_t curve) const {
    return 1 + kOfOneCurve * curve;
}

}  // namespace relume::basis
