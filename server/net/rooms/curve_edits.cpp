#include "server/net/rooms/curve_edits.h"

#include "protocol/base/text/near_names.h"
#include "protocol/curve/control_points.h"
#include "protocol/curve/curve_shape.h"
#include "protocol/curve/stroke.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/sections/section_json.h"
#include "server/net/library/editable_materials.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;
using wire::ErrorCode;
using wire::MaterialEdit;
using wire::WireError;

bool states(const json& patch, const char* key) {
    return patch.contains(key) && !patch[key].is_null();
}

// Removes a member, and gives it; null where there is none.
json taken(json& patch, const char* key) {
    json value;
    if (patch.is_object() && patch.contains(key)) {
        value = std::move(patch[key]);
        patch.erase(key);
    }
    return value;
}

// One material's part of a patch.
class MaterialPatch {
  public:
    MaterialPatch(const transport::CurveRecord& record,
                  const MaterialEdit* before,
                  const json& change,
                  std::string path)
        : angle_(curve::kCurveAngleNames.value(record.angle).value()),
          is_new_(before == nullptr),
          plain_(change),
          path_(std::move(path)),
          edit_(is_new_ ? edit_as_baked(record) : *before) {
        preset_ = taken(plain_, "preset");
        stroke_ = taken(plain_, "stroke");
    }

    [[nodiscard]] json spelled_out() {
        require_one_way();
        if (!preset_.is_null()) {
            take_preset();
        }
        const json normal =
            wire::SectionPatch<MaterialEdit>(wire::kMaterials.entry, plain_, path_)
                .apply(edit_);
        const bool is_drawn = !stroke_.is_null() || states(plain_, "samples");
        if (is_drawn) {
            forget_unless_stated();
        }
        if (!stroke_.is_null()) {
            edit_.samples = samples_from_curve(with_stroke());
        } else if (!is_drawn && changes_what_makes_samples(normal)) {
            edit_.samples = samples_from_curve(made_curve());
        } else if (!is_drawn && !is_new_) {
            return normal;
        }
        return wire::to_json(wire::kMaterials.entry, edit_, wire::Absent::null);
    }

  private:
    // Samples may come with what they were made from.
    void require_one_way() const {
        const bool has_samples = states(plain_, "samples");
        const std::array<std::pair<const char*, bool>, 5> ways{{
            {"preset", !preset_.is_null()},
            {"stroke", !stroke_.is_null()},
            {"samples", has_samples},
            {"points", !has_samples && states(plain_, "points")},
            {"shape", !has_samples && states(plain_, "shape")},
        }};
        std::string first;
        for (const auto& [key, is_stated] : ways) {
            if (!is_stated) {
                continue;
            }
            if (!first.empty()) {
                throw WireError(ErrorCode::unsupported, path_, first + " and " + key,
                                "one or the other");
            }
            first = key;
        }
    }

    // A preset that is one shape leaves the shape and its parameters, another one samples.
    void take_preset() {
        const std::string path = wire::pointer_step(path_, "preset");
        const std::string name = wire::string_from_json(preset_, path);
        const std::vector<std::string> known = presets_over(angle_);
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            throw WireError(ErrorCode::unknown_name, path, name,
                            text::expected_name(name, known, "presets"));
        }
        plain_.update(patch_from_preset(curve::preset_from_name(name)));
    }

    void forget_unless_stated() {
        if (!states(plain_, "points")) {
            edit_.points.reset();
        }
        if (!states(plain_, "shape")) {
            edit_.shape.reset();
        }
    }

    // `normal` is what the patch states. Points and a shape take each other's place.
    bool changes_what_makes_samples(const json& normal) {
        if (edit_.points && (states(normal, "points") || normal.contains("scale"))) {
            edit_.shape.reset();
            return true;
        }
        if (states(normal, "shape")) {
            edit_.points.reset();
            return true;
        }
        constexpr std::array kParameters{"roughness", "exponent", "n",    "e",
                                         "f0",        "f90",      "value"};
        return edit_.shape &&
               std::any_of(kParameters.begin(), kParameters.end(),
                           [&](const char* key) { return normal.contains(key); });
    }

    [[nodiscard]] curve::Curve made_curve() const {
        return refusing("", [&] {
            if (edit_.shape) {
                return curve::curve_from_shape(*edit_.shape, angle_, shape_values(edit_));
            }
            std::vector<curve::ControlPoint> points;
            const wire::NumberTable& table = *edit_.points;
            for (std::size_t row = 0; row < table.rows(); ++row) {
                const double* const numbers = &table.numbers[row * table.columns];
                points.push_back(
                    {.u = numbers[0], .value = Imath::V3d(numbers[1], numbers[2], numbers[3])});
            }
            return curve::curve_from_points(points, edit_.scale);
        });
    }

    [[nodiscard]] curve::Curve with_stroke() const {
        const std::string path = wire::pointer_step(path_, "stroke");
        wire::ObjectReader reader(stroke_, path);
        const auto end = [&](const char* key) {
            return wire::number_from_json(reader.require(key), reader.path_to(key), {0, 1});
        };
        curve::Stroke stroke{.from = end("from"), .to = end("to"), .softness = 0, .values = {}};
        if (reader.find("softness") != nullptr) {
            stroke.softness = end("softness");
        }
        wire::FieldRule rule{"values", wire::FieldKind::table, "", wire::kCurveValue};
        rule.table = {1, curve::kCurveSamples, 3};
        const auto values = std::get<wire::NumberTable>(
            wire::value_from_json(rule, reader.require("values"), reader.path_to("values")));
        reader.refuse_other_keys();
        for (std::size_t row = 0; row < values.rows(); ++row) {
            const double* const rgb = &values.numbers[row * values.columns];
            stroke.values.emplace_back(rgb[0], rgb[1], rgb[2]);
        }
        return refusing("stroke", [&] {
            return curve::with_stroke(curve_from_samples(edit_.samples), stroke);
        });
    }

    // What protocol/curve refuses is refused on the wire.
    template <typename Make>
    [[nodiscard]] curve::Curve refusing(const char* key, const Make& make) const {
        try {
            return make();
        } catch (const curve::CurveError& failure) {
            throw WireError(ErrorCode::out_of_range,
                            *key == 0 ? path_ : wire::pointer_step(path_, key), failure.what(),
                            "a curve as the contract describes it");
        }
    }

    curve::CurveAngle angle_;
    bool is_new_;
    json plain_;  // of the section's own fields
    std::string path_;
    MaterialEdit edit_;
    json preset_;
    json stroke_;
};

}  // namespace

json with_samples(const json& patch,
                  const wire::MaterialEdits& edits,
                  std::span<const transport::CurveRecord> curves) {
    const std::string section(wire::kMaterials.entry.key);
    if (curves.empty() || !patch.is_object() || !patch.contains(section) ||
        !patch[section].is_object()) {
        return patch;
    }
    json spelled = patch;
    for (auto& [id, change] : spelled[section].items()) {
        const auto record =
            std::find_if(curves.begin(), curves.end(),
                         [&](const transport::CurveRecord& r) { return r.id == id; });
        const std::string path = wire::pointer_step("/" + section, id);
        if (record == curves.end()) {
            std::vector<std::string> known;
            for (const transport::CurveRecord& curve : curves) {
                known.push_back(curve.id);
            }
            throw WireError(ErrorCode::unknown_name, path, id,
                            text::expected_name(id, known, "materials"));
        }
        if (!change.is_null()) {
            const auto before = edits.find(id);
            change = MaterialPatch(*record, before == edits.end() ? nullptr : &before->second,
                                   change, path)
                         .spelled_out();
        }
    }
    return spelled;
}

}  // namespace relume::net
