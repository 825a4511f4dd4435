// What is expected of the signals that a transport will be multiplied with: signals that stand
// for them, and how much each column of the transport matters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

// Natural signals are what is likely; the others are hard, and put their energy into few
// columns or into the finest. Of light these are a bare sun, of curves a stroke that ends
// abruptly.
enum SignalKind : std::uint8_t { kNatural, kSun, kSignalKinds };
inline constexpr std::size_t kSignalsPerKind = 4;
inline constexpr std::size_t kModelSignals = kSignalKinds * kSignalsPerKind;

// Of N columns.
struct SignalModel {
    // N coefficients each, colourless: kSignalsPerKind natural ones, then as many hard ones.
    std::vector<std::vector<float>> signals;
    std::vector<std::uint32_t> band;  // of each column: those of a band are alike
    // By band: what a squared error of one of its columns adds to that of the image under a
    // natural signal, up to a factor that all bands share.
    std::vector<double> natural_weight;
    // By band: how many times larger the band's quantisation steps are than those of a band
    // of 1.
    std::vector<float> step_growth;
    // Bits of precision beyond those that the parameters ask for: where people ask for signals
    // that are so much larger than the natural ones.
    std::uint32_t further_bits = 0;
};

}  // namespace relume::bake
