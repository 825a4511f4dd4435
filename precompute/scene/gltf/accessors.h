// Typed elements in the bytes of a document: accessors, dense and sparse.
#pragma once

#include "precompute/scene/gltf/buffer_views.h"
#include "precompute/scene/gltf/document.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace relume::scene::gltf {

// Elements of one accessor, or decompressed ones. Points into the BufferViews it came from.
class Elements {
  public:
    // Of values that are numbers already; `width` for each element.
    Elements(std::vector<float> values, std::size_t width);

    [[nodiscard]] std::size_t count() const { return count_; }
    // Numbers of an element: 1 to 4, 16 for a matrix.
    [[nodiscard]] std::size_t width() const { return width_; }
    // Component `c` of element `i`: integers as they are, or as fractions of their range where
    // the accessor is normalized. i < count(), c < width().
    [[nodiscard]] float number(std::size_t i, std::size_t c) const;
    // The same of an accessor of unsigned integers.
    [[nodiscard]] std::uint32_t whole(std::size_t i, std::size_t c) const;

  private:
    friend class Accessors;
    Elements() = default;

    // Where component `c` of element `i` stands; null: it is zero.
    [[nodiscard]] const std::uint8_t* place(std::size_t i, std::size_t c) const;

    std::size_t count_ = 0;
    std::size_t width_ = 0;
    int component_type_ = 0;
    bool is_normalized_ = false;
    std::size_t component_bytes_ = 0;
    std::size_t stride_ = 0;
    std::span<const std::uint8_t> dense_{};   // empty: zeros
    std::vector<std::uint32_t> replaced_{};   // sparse: these elements, ascending,
    std::span<const std::uint8_t> sparse_{};  // are these instead
    std::vector<float> own_{};
};

class Accessors {
  public:
    // Both must outlive this and the elements it hands out.
    Accessors(const Document& document, BufferViews& views)
        : document_(document), views_(views) {}

    // `who` refers to accessor `index`, for messages; `widths` are those allowed. Every range
    // is checked, `min` and `max` are not asked. Throws SceneError (corrupt_file).
    [[nodiscard]] Elements elements(int index,
                                    std::initializer_list<std::size_t> widths,
                                    const std::string& who);

    [[nodiscard]] const FileName& file() const { return document_.file; }

  private:
    void read_sparse(const tinygltf::Accessor& accessor,
                     const std::string& self,
                     Elements& elements);

    const Document& document_;
    BufferViews& views_;
};

}  // namespace relume::scene::gltf
