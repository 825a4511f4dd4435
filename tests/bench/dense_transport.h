// A transport whose every cell is dense: what bandwidth is measured on.
#pragma once

#include <cstdint>
#include <filesystem>

namespace relume::bench {

struct DenseTransportSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t face_resolution = 0;  // 6·n² columns of width·height bytes
};
// 600 MB, and 12 MB.
inline constexpr DenseTransportSize kDenseTransport{
    .width = 768, .height = 512, .face_resolution = 16};
inline constexpr DenseTransportSize kQuickDenseTransport{
    .width = 256, .height = 128, .face_resolution = 8};

// Random values in ±127, none of them zero; sides are multiples of a tile's. Throws
// transport::TransportError when it cannot be written.
void write_dense_transport(const std::filesystem::path& directory,
                           const DenseTransportSize& size);

}  // namespace relume::bench
