// 8-bit RGB to JPEG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::net {

// Keeps its buffers between images. Not thread-safe.
class JpegEncoder {
  public:
    // Above this quality colour is kept at full resolution.
    static constexpr int kFullChromaQuality = 90;

    JpegEncoder();

    // `rgb` is interleaved, row by row from the top, 3·width·height values; quality 1 … 100.
    // The result is valid until the next call. Throws std::runtime_error naming what the codec
    // said.
    [[nodiscard]] std::span<const std::byte> encode(std::span<const std::uint8_t> rgb,
                                                    std::uint32_t width,
                                                    std::uint32_t height,
                                                    int quality);

  private:
    struct Destroy {
        void operator()(void* compressor) const;
    };
    std::unique_ptr<void, Destroy> compressor_;
    std::vector<unsigned char> buffer_;
};

}  // namespace relume::net
