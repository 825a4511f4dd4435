// The bit-exact image payload: half-float planes as one zstd frame (protocol/README.md §3.2).
//
// Planes are R, G, B and, with alpha, A; each height·width values, row by row from the top. RGB
// is linear and premultiplied by A (coverage). On the wire each plane is split into all its low
// bytes and all its high bytes: neighbouring exponents are alike, and compress far better so.
#pragma once

#include <Imath/half.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::wire {

inline constexpr int kDefaultZstdLevel = 1;

struct HalfImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool has_alpha = false;
    std::vector<Imath::half> values;  // plane by plane

    [[nodiscard]] std::size_t plane_size() const { return std::size_t{width} * height; }
    [[nodiscard]] std::size_t plane_count() const { return has_alpha ? 4 : 3; }
    [[nodiscard]] std::span<const Imath::half> plane(std::size_t index) const {
        return std::span(values).subspan(index * plane_size(), plane_size());
    }
};

// Nearest half; beyond ±65504 the largest one, and 0 for NaN: a payload holds finite values.
[[nodiscard]] Imath::half half_from_linear(float value);

// Keeps its compression state and buffers between images; one per thread.
class HalfImageEncoder {
  public:
    // `zstd_level` as libzstd takes it; 1 is the fastest that still compresses well.
    explicit HalfImageEncoder(int zstd_level = kDefaultZstdLevel);
    ~HalfImageEncoder();
    HalfImageEncoder(HalfImageEncoder&&) noexcept;
    HalfImageEncoder& operator=(HalfImageEncoder&&) noexcept;
    HalfImageEncoder(const HalfImageEncoder&) = delete;
    HalfImageEncoder& operator=(const HalfImageEncoder&) = delete;

    // Appends the payload to `out` (after a header, say) and returns its length in bytes.
    // Throws std::invalid_argument when the number of values is not that of the sizes.
    std::size_t append_to(std::vector<std::byte>& out, const HalfImage& image);

  private:
    struct Context;
    std::unique_ptr<Context> context_;
};

// Throws WireError{bad_image} unless the payload is exactly one zstd frame that states and
// holds exactly the bytes that the sizes demand, all of them finite; nothing larger than that
// is ever allocated. The sizes come from a decoded header, which bounds them.
[[nodiscard]] HalfImage decode_half_image(std::span<const std::byte> payload,
                                          std::uint32_t width,
                                          std::uint32_t height,
                                          bool has_alpha);

}  // namespace relume::wire
