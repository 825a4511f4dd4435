// The dense product T·L, computed plainly and in double precision from the stored transport:
// what any cleverer way of relighting is checked against.
#pragma once

#include "protocol/transport/transport.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::bake {

// Radiance of the 6·n² texels, row-major (basis/cubemap.h), in red, green and blue.
using CubemapLight = std::array<std::vector<float>, 3>;

struct DenseImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::array<std::vector<double>, 3> rgb;  // height·width, linear, premultiplied by coverage
    std::vector<float> coverage;             // height·width, in [0, 1]
};

// A signal in the transport's basis.
struct SignalCoefficients {
    std::array<std::vector<float>, 3> rgb;  // N values each
};

// Throws BakeError when the light's size is not the transport's, or its signal is no light.
[[nodiscard]] SignalCoefficients coefficients_of_light(const transport::Transport& transport,
                                                       const CubemapLight& light);
// Materials as they were baked, of a transport of kind `curves`. Throws BakeError for others.
[[nodiscard]] SignalCoefficients coefficients_as_baked(const transport::Transport& transport);

// What every receiver has of the signal, tint applied: [blocks][3][256].
[[nodiscard]] std::vector<double> relit_receivers(const transport::Transport& transport,
                                                  const SignalCoefficients& signal);
// Of coefficients_of_light.
[[nodiscard]] std::vector<double> relit_receivers(const transport::Transport& transport,
                                                  const CubemapLight& light);

// The image of the transport's camera; of kind `mesh` at the size that the manifest names, with
// sixteen rays a pixel.
[[nodiscard]] DenseImage relight(const transport::Transport& transport,
                                 const SignalCoefficients& signal);
// Of coefficients_of_light.
[[nodiscard]] DenseImage relight(const transport::Transport& transport,
                                 const CubemapLight& light);

// A strip of the six faces, 6n×n or n×6n, of radiance, in any format OpenImageIO reads. Throws
// BakeError naming the file, what was found and what was expected.
[[nodiscard]] CubemapLight read_cubemap_strip(const std::filesystem::path& path,
                                              std::uint32_t face_resolution);

}  // namespace relume::bake
