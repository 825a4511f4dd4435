#include "server/materials/editable_points.h"

#include "protocol/curve/curve_angle.h"
#include "protocol/curve/curve_json.h"

#include <utility>

namespace relume::materials {
namespace {

// One without a specular part is GGX that reflects nothing, until somebody edits its Fresnel
// curve.
curve::CurveBrdf brdf_of(const transport::EditableRecord& record) {
    constexpr float kAlpha = 0.25F;
    return record.brdf.is_null()
               ? curve::CurveBrdf::ggx(Imath::V3f(0, 0, 0), 0, kAlpha)
               : curve::curve_brdf_from_json(record.brdf, "materials/" + record.id);
}

std::optional<brdf::Coat> coat_of(const transport::EditableRecord& record) {
    if (!record.coat) {
        return std::nullopt;
    }
    return brdf::Coat{.f0 = record.coat->f0, .f90 = record.coat->f90};
}

transport::CurveRecord record_of(const transport::EditableRecord& material,
                                 const curve::CurveBrdf& brdf,
                                 const curve::BrdfCurve& curve) {
    return {.id = material.id + "." + std::string(curve.name()),
            .name = material.name,
            .curve = std::string(curve.name()),
            .angle = std::string(curve::kCurveAngleNames.name(curve.angle)),
            .brdf = curve::json_from_curve_brdf(brdf),
            .baked = curve.curve.rgb};
}

}  // namespace

EditablePoints::EditablePoints(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)) {
    const transport::MaterialsSection& section = *transport_->manifest().materials;
    for (const transport::EditableRecord& record : section.editable) {
        materials_.push_back(
            {.id = record.id, .brdf = brdf_of(record), .coat = coat_of(record), .tiles = {}});
        const curve::CurveBrdf& brdf = materials_.back().brdf;
        for (std::size_t i = 0; i < brdf.curves().size(); ++i) {
            records_.push_back(record_of(record, brdf, brdf.curves()[i]));
            curves_.push_back({.material = materials_.size() - 1, .curve = i});
        }
    }
    for (std::uint32_t tile = 0; tile < image().block_count(); ++tile) {
        for (const transport::SeenPoint& point : points(tile)) {
            std::vector<std::uint32_t>& tiles = materials_[point.material].tiles;
            if (tiles.empty() || tiles.back() != tile) {
                tiles.push_back(tile);
            }
        }
    }
}

std::uint64_t EditablePoints::bytes() const {
    return transport_->manifest().materials->visibility.file.bytes +
           transport_->seen_points()->memory_bytes();
}

}  // namespace relume::materials
