#include "precompute/scene/texture.h"

#include "precompute/scene/error.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace relume::scene {
namespace {

// `index` may be anything; the result is in [0, size).
std::int64_t wrapped(std::int64_t index, std::int64_t size, Wrap wrap) {
    if (wrap == Wrap::clamp)
        return index < 0 ? 0 : (index >= size ? size - 1 : index);
    const std::int64_t period = wrap == Wrap::mirror ? 2 * size : size;
    std::int64_t place = index % period;
    if (place < 0)
        place += period;
    return place < size ? place : period - 1 - place;
}

// Coordinates beyond this have no fractional part left that could address a texel.
float bounded_coordinate(float value) {
    constexpr float kFarthest = 1e6F;
    return std::isfinite(value) && std::abs(value) <= kFarthest ? value : 0.0F;
}

}  // namespace

Texture::Texture(std::string name,
                 std::uint32_t width,
                 std::uint32_t height,
                 std::vector<half> rgba)
    : name_(std::move(name)), width_(width), height_(height), rgba_(std::move(rgba)) {
    if (width > kMaxTextureSide || height > kMaxTextureSide)
        throw SceneError(SceneFault::too_large,
                         fmt::format("texture '{}' has {}x{} texels; expected at most {}x{}",
                                     name_, width, height, kMaxTextureSide, kMaxTextureSide));
    if (width == 0 || height == 0 || rgba_.size() != std::size_t{4} * width * height)
        throw SceneError(SceneFault::bad_texture,
                         fmt::format("texture '{}' of {}x{} texels holds {} values", name_,
                                     width, height, rgba_.size()));
}

void Texture::set_wrap(Wrap u, Wrap v) {
    wrap_u_ = u;
    wrap_v_ = v;
}

Imath::V4f Texture::texel(std::int64_t column, std::int64_t row) const {
    const auto x = static_cast<std::size_t>(wrapped(column, width_, wrap_u_));
    const auto y = static_cast<std::size_t>(wrapped(row, height_, wrap_v_));
    const half* value = &rgba_[4 * (y * width_ + x)];
    return {value[0], value[1], value[2], value[3]};
}

Imath::V4f Texture::evaluate(const Imath::V2f& uv) const {
    // Doubles: a float has too few bits for the 8000th texel of the 100th repeat.
    const double x = double{bounded_coordinate(uv.x)} * width_ - 0.5;
    const double y = (1.0 - double{bounded_coordinate(uv.y)}) * height_ - 0.5;
    const double column = std::floor(x);
    const double row = std::floor(y);
    const auto fx = static_cast<float>(x - column);
    const auto fy = static_cast<float>(y - row);
    const auto c = static_cast<std::int64_t>(column);
    const auto r = static_cast<std::int64_t>(row);
    const Imath::V4f upper = texel(c, r) * (1.0F - fx) + texel(c + 1, r) * fx;
    const Imath::V4f lower = texel(c, r + 1) * (1.0F - fx) + texel(c + 1, r + 1) * fx;
    return upper * (1.0F - fy) + lower * fy;
}

}  // namespace relume::scene
