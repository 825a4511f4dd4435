#include "tests/lab/sequences/environment_source.h"

#include "protocol/basis/cubemap.h"
#include "protocol/light/environment_import.h"
#include "protocol/light/procedural_environment.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

namespace relume::lab {
namespace {

// Of Debian's blender-data, CC0.
const std::filesystem::path kPackagedMaps = "/usr/share/blender/datafiles/studiolights/world";

light::EnvironmentMap bare_sun() {
    constexpr std::uint32_t kSide = 512;
    constexpr float kSky = 0.01F;
    constexpr double kRadiusRadians = 0.5 * std::numbers::pi / 180;
    const double solid_angle = 2 * std::numbers::pi * (1 - std::cos(kRadiusRadians));
    const auto sun = static_cast<float>(std::numbers::pi / solid_angle);
    const Imath::V3f towards_sun = Imath::V3f(0.45F, 0.7F, 0.55F).normalized();
    light::MapImage image{.width = kSide, .height = basis::kFaceCount * kSide, .rgb = {}};
    for (std::size_t i = 0; i < basis::texel_count(kSide); ++i) {
        const Imath::V3f direction =
            basis::direction_from_texel(kSide, basis::texel_from_index(kSide, i));
        const bool in_sun = double{(direction - towards_sun).length()} < kRadiusRadians;
        image.rgb.insert(image.rgb.end(), 3, in_sun ? sun : kSky);
    }
    return {std::move(image), light::Projection::cubemap_strip};
}

light::EnvironmentMap load_map(const std::string& name_or_file) {
    if (name_or_file == "bare-sun") {
        return bare_sun();
    }
    const auto& names = light::procedural_environment_names();
    if (std::find(names.begin(), names.end(), name_or_file) != names.end()) {
        return light::procedural_environment(name_or_file);
    }
    const std::filesystem::path packaged = kPackagedMaps / (name_or_file + ".exr");
    return light::import_environment(std::filesystem::exists(packaged)
                                         ? packaged
                                         : std::filesystem::path(name_or_file))
        .map;
}

}  // namespace

std::shared_ptr<const light::PrefilteredEnvironment> load_environment(
    const std::string& name_or_file, std::uint32_t face_resolution, float sharpening) {
    return std::make_shared<const light::PrefilteredEnvironment>(
        std::make_shared<const light::EnvironmentMap>(load_map(name_or_file)), face_resolution,
        sharpening);
}

}  // namespace relume::lab
