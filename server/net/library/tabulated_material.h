// One file of a material for all normals and views, read when it is first used.
#pragma once

#include "protocol/tripling/material_field.h"
#include "server/net/library/resident_cache.h"
#include "server/triple/texel_material.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace relume::net {

// Thread-safe. Reading takes up to seconds: not for threads that serve sockets. Several callers
// wait for one reading.
class TabulatedMaterial {
  public:
    // Reads and checks the file, and keeps what describes it. Throws tripling::MaterialFileError
    // and files::FileError.
    TabulatedMaterial(std::filesystem::path file, std::shared_ptr<ResidentCache> cache);

    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    // Of its lobes.
    [[nodiscard]] const std::vector<Imath::V3f>& colours() const { return colours_; }
    // Read anew after the cache has let go of it. Throws as the constructor does; a failure is
    // remembered, not tried again. Spread over the caller's arena.
    [[nodiscard]] std::shared_ptr<const triple::TexelMaterial> texels();

  private:
    const std::filesystem::path file_;
    const std::shared_ptr<ResidentCache> cache_;
    std::uint32_t face_resolution_ = 0;
    std::vector<Imath::V3f> colours_;
    std::mutex mutex_;
    std::weak_ptr<const triple::TexelMaterial> texels_;
    std::optional<std::string> failure_;
};

}  // namespace relume::net
