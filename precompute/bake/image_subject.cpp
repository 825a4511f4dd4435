#include "precompute/bake/image_subject.h"

#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/fingerprint.h"
#include "precompute/bake/framing.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>

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

ImageSubject::ImageSubject(const RayCaster& caster,
                           const BakeParameters& parameters,
                           const FieldRequest& fields)
    : caster_(caster),
      scene_(caster.scene()),
      parameters_(parameters),
      pixels_(caster, parameters) {
    if (!fields.empty()) {
        editable_.emplace(caster, pixels_, fields, parameters);
    }
}

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
    manifest.camera = record_of(pixels_.camera(), scene_.frame);
    std::string fields;
    if (editable_) {
        const nlohmann::json request = editable_->request_json();
        manifest.bake.update(request);
        fields = request.dump();
        for (const EditableMaterial& material : editable_->materials()) {
            fields += fmt::format(" {}", material.material);
        }
    }
    manifest.fingerprint =
        fingerprint_of(scene_, pixels_.camera(), parameters_, manifest.generator, fields);
}

nlohmann::json ImageSubject::measured() const {
    if (!editable_) {
        return nlohmann::json::object();
    }
    nlohmann::json materials = nlohmann::json::array();
    for (std::size_t m = 0; m < editable_->materials().size(); ++m) {
        const EditableMaterial& material = editable_->materials()[m];
        materials.push_back({{"name", material.record.name},
                             {"in_view", static_cast<bool>(shown_.in_view[m])},
                             {"has_specular_textures", material.has_specular_textures}});
    }
    return {
        {"materials", std::move(materials)},
        {"visibility", json_from_counts(editable_->counts(), editable_->face_resolution())}};
}

std::vector<float> ImageSubject::coverage() {
    view_ = view_images(pixels_, scene_.frame.unit);
    if (editable_) {
        std::vector<std::uint32_t> materials;
        for (const EditableMaterial& material : editable_->materials()) {
            materials.push_back(material.material);
        }
        shown_ = shown_materials(pixels_, materials, scene_.materials.size());
    }
    return view_.coverage;
}

std::optional<std::uint64_t> ImageSubject::field_point_count() const {
    return editable_ ? std::optional(editable_->point_count()) : std::nullopt;
}

void ImageSubject::bake_fields(const FieldWork& work) {
    if (editable_) {
        editable_->bake(work);
    }
}

void ImageSubject::write_tables(transport::TransportWriter& writer) {
    if (editable_) {
        editable_->write(writer);
    }
}

void ImageSubject::write_files(const std::filesystem::path& directory) const {
    write_view_files(directory, view_);
    if (editable_) {
        write_shown_materials(directory, shown_);
    }
}

}  // namespace relume::bake
