#include "precompute/scene/gltf/buffer_views.h"

#include "precompute/scene/gltf/meshopt.h"

#include <fmt/format.h>

namespace relume::scene::gltf {

BufferViews::BufferViews(const Document& document,
                         const Container& container,
                         Resources& resources)
    : document_(document),
      container_(container),
      resources_(resources),
      loaded_(document.buffers.size()) {}

std::span<const std::uint8_t> BufferViews::buffer(std::size_t index) {
    const BufferSource& source = document_.buffers[index];
    const FileName& file = document_.file;
    std::span<const std::uint8_t> bytes;
    if (source.uri) {
        if (!loaded_[index]) {
            loaded_[index] = resources_.read(*source.uri);
            if (!loaded_[index])
                file.refuse(SceneFault::missing_file,
                            fmt::format("buffer {}: no file '{}' in the scene's folder", index,
                                        Resources::shown(*source.uri)));
        }
        bytes = *loaded_[index];
    } else if (index == 0 && container_.binary()) {
        bytes = *container_.binary();
    } else {
        file.refuse(SceneFault::corrupt_file,
                    fmt::format("buffer {} has no bytes; expected a uri", index));
    }
    if (bytes.size() < source.byte_length)
        file.refuse(SceneFault::corrupt_file,
                    fmt::format("buffer {} has {} bytes; expected {}", index, bytes.size(),
                                source.byte_length));
    return bytes.first(static_cast<std::size_t>(source.byte_length));
}

std::span<const std::uint8_t> BufferViews::range(int buffer_index,
                                                 std::uint64_t offset,
                                                 std::uint64_t length,
                                                 const std::string& who) {
    const std::size_t index =
        document_.file.checked_index(buffer_index, document_.buffers.size(), who, "buffer");
    const auto all = buffer(index);
    if (offset > all.size() || length > all.size() - offset)
        document_.file.refuse(SceneFault::corrupt_file,
                              fmt::format("{} is {} bytes at {} of buffer {}, which has {}",
                                          who, length, offset, index, all.size()));
    return all.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::span<const std::uint8_t> BufferViews::bytes(int index, const std::string& who) {
    const auto& views = document_.model.bufferViews;
    const std::size_t checked =
        document_.file.checked_index(index, views.size(), who, "buffer view");
    const tinygltf::BufferView& view = views[checked];
    const std::string self = fmt::format("buffer view {}", checked);
    const auto extension = view.extensions.find(kMeshoptExtension);
    if (extension == view.extensions.end())
        return range(view.buffer, view.byteOffset, view.byteLength, self);
    if (const auto known = decompressed_.find(checked); known != decompressed_.end())
        return known->second;
    const MeshoptView packed = meshopt_view(extension->second, document_.file, self);
    if (packed.count * packed.stride != view.byteLength)
        document_.file.refuse(SceneFault::corrupt_file,
                              fmt::format("{} has {} bytes; expected {} elements of {} bytes",
                                          self, view.byteLength, packed.count, packed.stride));
    const auto from = range(packed.buffer, packed.offset, packed.length, self);
    return decompressed_.emplace(checked, decompressed(packed, from, document_.file, self))
        .first->second;
}

std::size_t BufferViews::stride(int index) const {
    return document_.model.bufferViews[static_cast<std::size_t>(index)].byteStride;
}

}  // namespace relume::scene::gltf
