#include "tests/unit/scene/gltf_builder.h"

namespace relume::test {

std::size_t GltfBuilder::buffer(const std::vector<std::uint8_t>& bytes) {
    document["buffers"].push_back(
        {{"byteLength", bytes.size()},
         {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    return document["buffers"].size() - 1;
}

std::size_t GltfBuilder::view(const std::vector<std::uint8_t>& bytes) {
    document["bufferViews"].push_back(
        {{"buffer", buffer(bytes)}, {"byteLength", bytes.size()}});
    return document["bufferViews"].size() - 1;
}

std::size_t GltfBuilder::accessor(std::size_t view,
                                  int component_type,
                                  std::size_t count,
                                  const std::string& type,
                                  bool is_normalized) {
    document["accessors"].push_back({{"bufferView", view},
                                     {"componentType", component_type},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", is_normalized}});
    return document["accessors"].size() - 1;
}

}  // namespace relume::test
