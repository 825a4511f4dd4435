#include "precompute/scene/gltf/fault.h"

#include <fmt/format.h>

namespace relume::scene::gltf {

void FileName::refuse(SceneFault fault, const std::string& why) const {
    throw SceneError(fault, fmt::format("scene '{}': {}", shown_, why));
}

std::size_t FileName::checked_index(long long index,
                                    std::size_t count,
                                    const std::string& who,
                                    const char* what) const {
    if (index < 0 || static_cast<unsigned long long>(index) >= count)
        refuse(SceneFault::corrupt_file,
               fmt::format("{} refers to {} {}; expected below {}", who, what, index, count));
    return static_cast<std::size_t>(index);
}

}  // namespace relume::scene::gltf
