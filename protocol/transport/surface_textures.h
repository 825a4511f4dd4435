// Pictures on a surface: what lobe colours are multiplied with, pixel by pixel.
#pragma once

#include <Imath/ImathVec.h>
#include <Imath/half.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace relume::transport {

// Beyond [0, 1) a texture is repeated, mirrored at every whole number, or goes on as its edge.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };

struct SurfaceTexture {
    static constexpr std::uint32_t kMostSide = 8192;

    std::uint32_t width = 0;   // 1 … kMostSide
    std::uint32_t height = 0;  // 1 … kMostSide
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    // height·width·3: linear red, green, blue, finite and not negative, rows from the top. Its
    // lower left corner has the texture coordinates (0, 0).
    std::vector<half> rgb;
};

// Red at texture coordinates, bilinear between the middles of texels. Finite wherever it is
// looked at. Thread-safe.
[[nodiscard]] float red_at(const SurfaceTexture& texture, const Imath::V2f& uv);

// The content of textures.bin (protocol/README.md §2), which may hold none. Reading checks that
// the length is that of the sizes before anything is allocated for them; it throws
// TransportError naming `file`, what was found and what was expected.
[[nodiscard]] std::vector<std::byte> bytes_from_textures(
    std::span<const SurfaceTexture> textures);
[[nodiscard]] std::vector<SurfaceTexture> textures_from_bytes(std::span<const std::byte> bytes,
                                                              std::string_view file);

}  // namespace relume::transport
