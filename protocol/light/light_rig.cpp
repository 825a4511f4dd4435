#include "protocol/light/light_rig.h"

#include "protocol/light/rotation_resample.h"

namespace relume::light {

void evaluate(const LightRig& rig, std::uint32_t n, LightCubemap& out) {
    out.reset(n);
    const float amount = rig.blend ? rig.blend_amount : 0.0F;
    if (rig.environment && amount < 1) {
        resample(*rig.environment, rig.rotation, (1 - amount) * rig.environment_scale,
                 Write::overwrite, out);
    }
    if (amount > 0) {
        resample(*rig.blend, rig.rotation, amount * rig.environment_scale, Write::accumulate,
                 out);
    }
    for (const AreaLight& light : rig.lights) {
        add_area_light(light, out);
    }
}

}  // namespace relume::light
