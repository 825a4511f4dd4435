// Adds accessors, views and buffers to a glTF document of a test.
#pragma once

#include "tests/unit/scene/gltf_file.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace relume::test {

class GltfBuilder {
  public:
    explicit GltfBuilder(nlohmann::json base) : document(std::move(base)) {}

    // A buffer of these bytes in a data URI; returns its index.
    std::size_t buffer(const std::vector<std::uint8_t>& bytes);
    // A buffer view over a buffer of its own; returns its index.
    std::size_t view(const std::vector<std::uint8_t>& bytes);
    // Returns its index.
    std::size_t accessor(std::size_t view,
                         int component_type,
                         std::size_t count,
                         const std::string& type,
                         bool is_normalized = false);
    // Elements of any plain type, tightly packed.
    template <typename Element>
    std::size_t accessor_of(const std::vector<Element>& elements,
                            int component_type,
                            const std::string& type,
                            bool is_normalized = false) {
        return accessor(view(bytes_of(elements)), component_type, elements.size(), type,
                        is_normalized);
    }
    template <typename Element>
    static std::vector<std::uint8_t> bytes_of(const std::vector<Element>& elements) {
        std::vector<std::uint8_t> bytes(elements.size() * sizeof(Element));
        std::memcpy(bytes.data(), elements.data(), bytes.size());
        return bytes;
    }
    nlohmann::json& primitive() { return document["meshes"][0]["primitives"][0]; }
    nlohmann::json& attributes() { return primitive()["attributes"]; }

    nlohmann::json document;
};

// componentType
inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;

}  // namespace relume::test
