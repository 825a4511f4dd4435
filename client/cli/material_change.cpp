#include "client/cli/material_change.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/sections/field_json.h"
#include "protocol/wire/sections/materials.h"

#include <string_view>

namespace relume::cli {
namespace {

using nlohmann::json;
using wire::FieldKind;
using wire::FieldRule;

Imath::V3d value_of(const FieldRule& rule, const json& value, const std::string& path) {
    if (rule.kind == FieldKind::triple) {
        return wire::vector_from_json(value, path, rule.range);
    }
    const double number = wire::number_from_json(value, path, rule.range);
    return {number, number, number};
}

MaterialChange::Field field_from(const FieldRule& rule,
                                 const json& ends,
                                 const std::string& path) {
    if (!ends.is_array() || ends.size() != 2) {
        throw wire::WireError(wire::ErrorCode::wrong_type, path, wire::quote(ends),
                              "two values, [from, to]");
    }
    return {.key = std::string(rule.key),
            .is_triple = rule.kind == FieldKind::triple,
            .from = value_of(rule, ends[0], path + "/0"),
            .to = value_of(rule, ends[1], path + "/1")};
}

}  // namespace

json MaterialChange::patch_at(double way) const {
    json entry = json::object();
    if (!shape.empty()) {
        entry["shape"] = shape;
    }
    for (const Field& field : fields) {
        const Imath::V3d value = field.from + (field.to - field.from) * way;
        entry[field.key] = field.is_triple ? json{value.x, value.y, value.z} : json(value.x);
    }
    return {{"materials", {{id, std::move(entry)}}}};
}

MaterialChange material_change_from(wire::ObjectReader& reader) {
    MaterialChange change{
        .id = wire::name_from_json(reader.require("id"), reader.path_to("id")),
        .shape = {},
        .fields = {}};
    std::string known;
    for (const wire::Field<wire::MaterialEdit>& field : wire::kMaterialFields) {
        const FieldRule& rule = field.rule;
        if (rule.key == "shape") {
            if (const json* shape = reader.find(rule.key)) {
                const auto word = wire::value_from_json(rule, *shape, reader.path_to(rule.key));
                change.shape = std::get<std::string>(word);
            }
        }
        if (rule.kind != FieldKind::number && rule.kind != FieldKind::triple) {
            continue;
        }
        known += (known.empty() ? "" : ", ") + std::string(rule.key);
        if (const json* ends = reader.find(rule.key)) {
            change.fields.push_back(field_from(rule, *ends, reader.path_to(rule.key)));
        }
    }
    if (change.fields.empty()) {
        throw wire::WireError(wire::ErrorCode::missing_field, reader.path_to("id"),
                              "a material and nothing that changes", "some of " + known);
    }
    return change;
}

}  // namespace relume::cli
