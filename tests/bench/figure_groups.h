// Every group of figures; each is defined in the file of its name.
#pragma once

#include "tests/bench/figure.h"

namespace relume::bench {

[[nodiscard]] FigureGroup bandwidth_figures();
[[nodiscard]] FigureGroup peer_figures();
[[nodiscard]] FigureGroup full_product_figures();
[[nodiscard]] FigureGroup exact_image_figures();
[[nodiscard]] FigureGroup batch_figures();
[[nodiscard]] FigureGroup served_figures();
[[nodiscard]] FigureGroup bytes_figures();
[[nodiscard]] FigureGroup drift_figures();
[[nodiscard]] FigureGroup flagship_figures();

}  // namespace relume::bench
