// The two forms of a glTF file: JSON alone, or GLB, JSON and a binary chunk in one.
#pragma once

#include "precompute/scene/gltf/fault.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace relume::scene::gltf {

class Container {
  public:
    // Reads the whole file; which form it has is told by its first bytes, not by its name.
    // Throws SceneError (missing_file, corrupt_file).
    Container(const std::filesystem::path& path, const FileName& file);
    // The spans below point into the file's bytes.
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;
    Container(Container&&) = delete;
    Container& operator=(Container&&) = delete;
    ~Container() = default;

    [[nodiscard]] std::string_view json() const { return json_; }
    // The binary chunk of a GLB, if it has one.
    [[nodiscard]] std::optional<std::span<const std::uint8_t>> binary() const {
        return binary_;
    }

  private:
    std::string bytes_;
    std::string_view json_;
    std::optional<std::span<const std::uint8_t>> binary_;
};

// A whole file. Throws SceneError (missing_file, too_large).
[[nodiscard]] std::string read_file(const std::filesystem::path& path,
                                    std::uint64_t max_bytes,
                                    const FileName& file);

}  // namespace relume::scene::gltf
