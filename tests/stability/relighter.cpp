#include "tests/stability/relighter.h"

#include "tests/stability/test_light.h"

namespace relume::stability {

Relighter::Relighter(const lab::LabScene& scene, const std::string& method)
    : scene_(scene.haar), contestant_(lab::method_from_text(method).enter(scene)) {}

Relit Relighter::relit(const light::LightCubemap& light) {
    const Lighting haar = lighting_from_cubemap(light);
    contestant_->set_light({.radiance = light, .haar = haar});
    (void)contestant_->step();
    Relit relit;
    contestant_->write_radiance(relit.light);
    const auto& size = scene_->image();
    relit.image = {size.width, size.height, {}};
    relit.image.rgb.resize(std::size_t{3} * size.width * size.height);
    contestant_->write_image(relit.image.rgb);
    return relit;
}

}  // namespace relume::stability
