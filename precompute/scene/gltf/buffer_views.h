// The bytes of a document's buffer views, read when first asked for, checked, decompressed.
#pragma once

#include "precompute/scene/gltf/document.h"
#include "precompute/scene/gltf/resources.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::scene::gltf {

class BufferViews {
  public:
    // All three must outlive this.
    BufferViews(const Document& document, const Container& container, Resources& resources);

    // Bytes of buffer view `index`, valid as long as this object; those of
    // EXT_meshopt_compression decompressed. `who` refers to it, for messages. Throws SceneError
    // (missing_file, corrupt_file, too_large).
    [[nodiscard]] std::span<const std::uint8_t> bytes(int index, const std::string& who);
    // Distance of its elements; 0: they lie one after the other.
    [[nodiscard]] std::size_t stride(int index) const;

  private:
    [[nodiscard]] std::span<const std::uint8_t> buffer(std::size_t index);
    [[nodiscard]] std::span<const std::uint8_t> range(int buffer_index,
                                                      std::uint64_t offset,
                                                      std::uint64_t length,
                                                      const std::string& who);

    const Document& document_;
    const Container& container_;
    Resources& resources_;
    std::vector<std::optional<std::vector<std::uint8_t>>> loaded_;   // by buffer
    std::map<std::size_t, std::vector<std::uint8_t>> decompressed_;  // by buffer view
};

}  // namespace relume::scene::gltf
