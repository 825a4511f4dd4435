#include "precompute/bake/image_subject.h"

#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/fingerprint.h"
#include "precompute/bake/framing.h"

#include <nlohmann/json.hpp>

namespace relume::bake {
namespace {

transport::CameraRecord record_of(const scene::Camera& camera, const scene::WorldFrame& frame) {
    return {.eye = Imath::V3f(frame.world_from_position(camera.eye())),
            .right = camera.right(),
            .up = camera.up(),
            .forward = camera.forward(),
            .tan_half_width = camera.tan_half_width(),
            .tan_half_height = camera.tan_half_height()};
}

}  // namespace

ImageSubject::ImageSubject(const RayCaster& caster, const BakeParameters& parameters)
    : caster_(caster),
      scene_(caster.scene()),
      parameters_(parameters),
      pixels_(caster, parameters) {}

std::unique_ptr<RowSource> ImageSubject::rows() const {
    return std::make_unique<LightRows>(caster_, pixels_, parameters_);
}

transport::SamplingError ImageSubject::sampling_error(
    std::span<const ClusterSample> samples) const {
    BakeParameters with_other_seed = parameters_;
    with_other_seed.seed = other_seed(parameters_);
    const PixelReceivers other(caster_, with_other_seed);
    return measure_sampling_error(caster_, pixels_, other, parameters_, samples);
}

void ImageSubject::check() const {
    check_framing(scene_, pixels_);
}

void ImageSubject::describe(transport::Manifest& manifest) const {
    manifest.kind = transport::Kind::image;
    manifest.signal_basis = signal_basis(parameters_);
    manifest.layout = transport::ReceiverLayout::pixel_tiles(pixels_.image());
    manifest.block_basis = transport::BlockBasis::haar_tile;
    manifest.camera = record_of(pixels_.camera(), scene_.frame);
    manifest.fingerprint =
        fingerprint_of(scene_, pixels_.camera(), parameters_, manifest.generator);
}

nlohmann::json ImageSubject::measured() const {
    return nlohmann::json::object();
}

std::vector<float> ImageSubject::coverage() {
    view_ = view_images(pixels_, scene_.frame.unit);
    return view_.coverage;
}

void ImageSubject::write_files(const std::filesystem::path& directory) const {
    write_view_files(directory, view_);
}

}  // namespace relume::bake
