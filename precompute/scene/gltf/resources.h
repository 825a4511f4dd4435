// Bytes that a document names by URI: in the URI itself or in a file of the scene's folder.
#pragma once

#include "precompute/scene/gltf/fault.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relume::scene::gltf {

class Resources {
  public:
    // No more than `max_bytes` are read, all URIs together.
    Resources(FileName file, std::filesystem::path folder, std::uint64_t max_bytes)
        : file_(std::move(file)), folder_(std::move(folder)), left_(max_bytes) {}

    // The bytes of a data URI (RFC 2397; any media type, base64 or percent-encoded) or of a
    // file inside the folder, named as it stands or percent-encoded. Nothing where there is no
    // such file. Throws SceneError (corrupt_file, too_large).
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> read(const std::string& uri);
    // `uri` fit for a message: escaped, a data URI only by its beginning.
    [[nodiscard]] static std::string shown(const std::string& uri);

  private:
    FileName file_;
    std::filesystem::path folder_;
    std::uint64_t left_;
};

}  // namespace relume::scene::gltf
