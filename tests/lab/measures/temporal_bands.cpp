#include "tests/lab/measures/temporal_bands.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace relume::lab {
namespace {

// In place; [0] the mean times √n, then differences from the longest to the shortest.
void transform(std::vector<double>& series, std::vector<double>& scratch) {
    for (std::size_t count = series.size(); count > 1; count /= 2) {
        const std::size_t half = count / 2;
        for (std::size_t i = 0; i < half; ++i) {
            scratch[i] = (series[2 * i] + series[2 * i + 1]) / std::numbers::sqrt2;
            scratch[half + i] = (series[2 * i] - series[2 * i + 1]) / std::numbers::sqrt2;
        }
        std::copy_n(scratch.begin(), count, series.begin());
    }
}

}  // namespace

void TemporalBands::add(std::span<const float> lighting) {
    lightings_.emplace_back(lighting.begin(), lighting.end());
}

TemporalSpectrum TemporalBands::spectrum() const {
    TemporalSpectrum spectrum;
    if (lightings_.empty()) {
        return spectrum;
    }
    const std::size_t images = std::bit_floor(lightings_.size());
    spectrum.images = static_cast<std::uint32_t>(images);
    const std::size_t spatial_bands =
        std::size_t{*std::max_element(bands_.begin(), bands_.end())} + 1;
    spectrum.energy.assign(spatial_bands, std::vector<double>(std::bit_width(images)));
    std::vector<double> series(images);
    std::vector<double> scratch(images);
    for (std::size_t i = 0; i < lightings_.front().size(); ++i) {
        for (std::size_t image = 0; image < images; ++image) {
            series[image] = lightings_[image][i];
        }
        transform(series, scratch);
        std::vector<double>& energy = spectrum.energy[bands_[i % bands_.size()]];
        for (std::size_t t = 0; t < images; ++t) {
            energy[std::bit_width(t)] += series[t] * series[t];
        }
    }
    return spectrum;
}

}  // namespace relume::lab
