#include "protocol/transport/materials_section.h"

#include "protocol/base/text/names.h"
#include "protocol/basis/cubemap.h"
#include "protocol/curve/curve_json.h"

#include <fmt/format.h>

#include <set>

namespace relume::transport {
namespace {

using nlohmann::json;

CoatRecord coat_record(const ManifestReader& object) {
    const CoatRecord coat{.f0 = object.number("f0"), .f90 = object.number("f90")};
    if (!(coat.f0 >= 0 && coat.f0 <= coat.f90 && coat.f90 <= 1)) {
        object.fail("f0", fmt::format("{} with f90 {}", coat.f0, coat.f90),
                    "0 <= f0 <= f90 <= 1");
    }
    return coat;
}

EditableRecord editable_record(const ManifestReader& record) {
    EditableRecord material{.id = record.string("id"),
                            .name = record.string("name"),
                            .brdf = record.member("brdf"),
                            .coat = {}};
    if (!text::is_name(material.id)) {
        record.fail("id", text::quote(material.id), std::string(text::kNameRule));
    }
    if (!material.brdf.is_null()) {
        try {
            (void)curve::curve_brdf_from_json(material.brdf, record.place() + ".brdf");
        } catch (const curve::CurveError& error) {
            throw TransportError(error.what());
        }
    }
    if (!record.member("coat").is_null()) {
        material.coat = coat_record(record.object("coat"));
    }
    return material;
}

json json_from(const EditableRecord& material) {
    json coat;
    if (material.coat) {
        coat = {{"f0", material.coat->f0}, {"f90", material.coat->f90}};
    }
    return {{"id", material.id},
            {"name", material.name},
            {"brdf", material.brdf},
            {"coat", std::move(coat)}};
}

}  // namespace

json json_from(const VisibilityRecord& visibility) {
    json object = json_from(visibility.file);
    object["face_resolution"] = visibility.face_resolution;
    return object;
}

VisibilityRecord visibility_record(const ManifestReader& object) {
    const std::uint32_t n = object.integer32("face_resolution", basis::kMinFaceResolution,
                                             basis::kMaxFaceResolution);
    if (!basis::is_face_resolution(n)) {
        object.fail("face_resolution", std::to_string(n), "a power of two from 4 to 256");
    }
    return {.face_resolution = n, .file = file_record(object)};
}

json json_from(const MaterialsSection& materials) {
    json editable = json::array();
    for (const EditableRecord& material : materials.editable) {
        editable.push_back(json_from(material));
    }
    return {{"visibility", json_from(materials.visibility)},
            {"points", json_from(materials.points)},
            {"editable", std::move(editable)}};
}

MaterialsSection materials_section(const ManifestReader& object) {
    const json& list = object.member("editable");
    if (!list.is_array() || list.empty() || list.size() > MaterialsSection::kMostMaterials) {
        object.fail("editable",
                    list.is_array() ? std::to_string(list.size()) : list.type_name(),
                    fmt::format("an array of 1 to {}", MaterialsSection::kMostMaterials));
    }
    MaterialsSection section{.visibility = visibility_record(object.object("visibility")),
                             .points = file_record(object.object("points")),
                             .editable = {}};
    std::set<std::string> ids;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const ManifestReader record(list[i], fmt::format("{}.editable[{}]", object.place(), i));
        section.editable.push_back(editable_record(record));
        if (!ids.insert(section.editable.back().id).second) {
            record.fail("id", text::quote(section.editable.back().id), "each id once");
        }
    }
    return section;
}

}  // namespace relume::transport
