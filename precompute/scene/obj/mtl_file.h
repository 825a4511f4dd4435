// The materials of an MTL file, as it states them.
#pragma once

#include "precompute/scene/polygons/add_meshes.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace relume::scene::obj {

// `map_Kd -s 2 2 1 -o .5 0 0 wood.png`
struct MtlTexture {
    std::string file{};
    UvTransform transform{};
    bool is_clamped = false;  // -clamp on
    float bump = 1;           // -bm
    char channel = 'l';       // -imfchan: r, g, b, m (matte: alpha), l (luminance), z
    std::string ignored{};    // options that change the picture and are not read
};

struct MtlMaterial {
    std::string name{};
    std::optional<Imath::V3f> diffuse{};   // Kd
    std::optional<Imath::V3f> specular{};  // Ks
    std::optional<Imath::V3f> emission{};  // Ke
    std::optional<float> exponent{};       // Ns
    std::optional<float> roughness{};      // Pr
    std::optional<float> metallic{};       // Pm
    float dissolve = 1;                    // d, or 1 − Tr
    // By keyword in lower case, without `map_`: kd, ks, ns, ke, ka, d, pr, pm, bump, norm, …
    std::map<std::string, MtlTexture> textures{};
    std::vector<std::string> ignored{};  // statements that change the picture and are not read
};

// Throws SceneError (corrupt_file, too_large).
[[nodiscard]] std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path,
                                                std::uint64_t max_bytes);

}  // namespace relume::scene::obj
