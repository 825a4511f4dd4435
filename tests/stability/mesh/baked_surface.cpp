#include "tests/stability/mesh/baked_surface.h"

#include "precompute/bake/bake.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"

namespace relume::stability {

bake::BakeParameters surface_parameters(std::uint32_t most_vertices) {
    bake::BakeParameters parameters;
    parameters.receivers = bake::ReceiverKind::vertices;
    parameters.width = 32;
    parameters.height = 32;
    parameters.face_resolution = 16;
    parameters.bounces = 0;
    parameters.vertices = most_vertices;
    return parameters;
}

BakedSurface::BakedSurface(const scene::Scene& scene, const bake::BakeParameters& parameters) {
    // What has been opened is mapped and outlives its folder.
    const test::ScratchDirectory scratch;
    const auto directory = scratch.path() / "surface.relume";
    bake::bake(scene, parameters, directory);
    scene_ = std::make_shared<const served::Scene>(transport::Transport::open(directory));
    view_ = scene_->make_view();
}

std::vector<float> BakedSurface::exact_sums(const Lighting& lighting) const {
    engine::Session session(scene_->workspace(), {});
    session.set_target(lighting);
    run_until_exact(session);
    return {session.sums().begin(), session.sums().end()};
}

RelitImage BakedSurface::image_of_sums(const view::Look& look,
                                       std::span<const float> sums) const {
    view_->look(look);
    view_->look_closer();
    view_->sums_have_changed();
    RelitImage image{look.width, look.height, {}};
    image.rgb.resize(std::size_t{3} * look.width * look.height);
    view::write_image(*view_, sums, image.rgb);
    return image;
}

}  // namespace relume::stability
