// A picture on a surface: linear half floats, filtered bilinearly.
#pragma once

#include <Imath/ImathVec.h>
#include <Imath/half.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::scene {

inline constexpr std::uint32_t kMaxTextureSide = 8192;

enum class Wrap : std::uint8_t { repeat, mirror, clamp };

class Texture {
  public:
    // `rgba`: height·width·4 values, linear, rows from the top. Throws SceneError
    // (bad_texture, too_large) where the sizes do not fit or a side exceeds kMaxTextureSide.
    Texture(std::string name,
            std::uint32_t width,
            std::uint32_t height,
            std::vector<half> rgba);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] std::span<const half> texels() const { return rgba_; }
    void set_wrap(Wrap u, Wrap v);
    [[nodiscard]] Wrap wrap_u() const { return wrap_u_; }
    [[nodiscard]] Wrap wrap_v() const { return wrap_v_; }

    // Linear RGBA at uv; (0, 0) is the lower left corner of the picture, v grows upwards.
    // Thread-safe.
    [[nodiscard]] Imath::V4f evaluate(const Imath::V2f& uv) const;

  private:
    [[nodiscard]] Imath::V4f texel(std::int64_t column, std::int64_t row) const;

    std::string name_;
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<half> rgba_;
    Wrap wrap_u_ = Wrap::repeat;
    Wrap wrap_v_ = Wrap::repeat;
};

// Whether the file's numbers are a display-referred picture to be decoded from sRGB, or data
// (normals, roughness). Pictures in float formats are linear either way.
enum class TextureContent : std::uint8_t { colour, data };

// Decodes an image file through OpenImageIO. Throws SceneError (missing_file, bad_texture,
// too_large).
[[nodiscard]] Texture load_texture(const std::string& path, TextureContent content);
// The same for an image file held in memory; `name` appears in errors.
[[nodiscard]] Texture decode_texture(const std::string& name,
                                     std::span<const std::uint8_t> file,
                                     TextureContent content);

}  // namespace relume::scene
