#include "tests/lab/sequences/map_cubemap.h"

#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"
#include "tests/lab/sequences/environment_source.h"

#include <span>
#include <utility>

namespace relume::lab {

bake::CubemapLight cubemap_of_map(const std::string& name, std::uint32_t face_resolution) {
    light::LightRig rig;
    rig.environment = load_environment(name, face_resolution);
    light::LightCubemap cubemap;
    light::evaluate(rig, face_resolution, cubemap);
    bake::CubemapLight light;
    for (std::size_t c = 0; c < light.size(); ++c) {
        const std::span<const float> plane = std::as_const(cubemap).planes()[c];
        light[c].assign(plane.begin(), plane.end());
    }
    return light;
}

}  // namespace relume::lab
