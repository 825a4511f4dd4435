#include "server/net/rooms/edited_materials.h"

#include "server/net/library/editable_materials.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <string>

namespace relume::net {
namespace {

const wire::MaterialEdit* edit_of(const wire::MaterialEdits& edits, const std::string& id) {
    const auto found = edits.find(id);
    return found == edits.end() ? nullptr : &found->second;
}

bool is_same(const wire::MaterialEdit* a, const wire::MaterialEdit* b) {
    return a == b || (a != nullptr && b != nullptr && *a == *b);
}

// A tint may take samples past what a BRDF's curve has.
curve::Curve bounded(curve::Curve curve) {
    for (auto& channel : curve.rgb) {
        for (float& sample : channel) {
            sample = std::min(sample, curve::kMostCurveValue);
        }
    }
    return curve;
}

}  // namespace

bool EditedMaterials::set_edits(const wire::MaterialEdits& edits) {
    if (edits == edits_) {
        return false;
    }
    for (std::size_t i = 0; i < points_->curves().size(); ++i) {
        const std::string& id = points_->records()[i].id;
        const wire::MaterialEdit* const edit = edit_of(edits, id);
        const materials::EditableCurve& curve = points_->curves()[i];
        if (edit != nullptr && !is_same(edit_of(edits_, id), edit)) {
            taken_up_[curve.material] = curve.curve;
        }
    }
    edits_ = edits;
    return true;
}

std::vector<materials::ShownMaterial> EditedMaterials::shown() const {
    std::vector<materials::ShownMaterial> all;
    for (std::size_t i = 0; i < points_->curves().size(); ++i) {
        const wire::MaterialEdit* const edit = edit_of(edits_, points_->records()[i].id);
        if (edit == nullptr) {
            continue;
        }
        const materials::EditableCurve& curve = points_->curves()[i];
        if (all.empty() || all.back().material != curve.material) {
            all.push_back({.material = curve.material,
                           .brdf = points_->materials()[curve.material].brdf,
                           .diffuse = Imath::V3f(1, 1, 1),
                           .taken_up = taken_up_[curve.material].value_or(curve.curve)});
        }
        materials::ShownMaterial& shown = all.back();
        shown.brdf = shown.brdf.with_curve(curve.curve, bounded(edited_curve(*edit)));
        shown.diffuse *= Imath::V3f(edit->diffuse);
    }
    return all;
}

}  // namespace relume::net
