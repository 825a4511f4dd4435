#include "client/cli/finish_change.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/sections/finishes.h"

#include <cmath>

namespace relume::cli {
namespace {

using nlohmann::json;

constexpr wire::Range kChangingParameter{1e-4, 1e5};

const json& ends_of(const json& value, const std::string& path) {
    if (!value.is_array() || value.size() != 2) {
        throw wire::WireError(wire::ErrorCode::wrong_type, path, wire::quote(value),
                              "two values, [from, to]");
    }
    return value;
}

FinishChange::Colours colours_from(const json& value, const std::string& path) {
    if (!value.is_array() || value.empty() || value.size() > wire::kMostLobes) {
        throw wire::WireError(wire::ErrorCode::wrong_type, path, wire::quote(value),
                              "an array of 1 to 4 colours");
    }
    FinishChange::Colours colours;
    for (std::size_t i = 0; i < value.size(); ++i) {
        colours.push_back(wire::vector_from_json(
            value[i], wire::pointer_step(path, std::to_string(i)), wire::kColour));
    }
    return colours;
}

}  // namespace

json FinishChange::patch_at(double way) const {
    json finish = {{"material", material}};
    if (parameter) {
        const auto& [from, to] = *parameter;
        finish["parameter"] = way == 1 ? to : from * std::pow(to / from, way);
    }
    if (colours) {
        const auto& [from, to] = *colours;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Imath::V3d colour = from[i] + (to[i] - from[i]) * way;
            finish["colours"].push_back({colour.x, colour.y, colour.z});
        }
    }
    return {{"finishes", {{part, std::move(finish)}}}};
}

FinishChange finish_change_from(wire::ObjectReader& reader) {
    const auto name = [&](const char* key) {
        return wire::name_from_json(reader.require(key), reader.path_to(key));
    };
    FinishChange change{
        .part = name("part"), .material = name("material"), .parameter = {}, .colours = {}};
    if (const json* value = reader.find("parameter")) {
        const std::string path = reader.path_to("parameter");
        const json& ends = ends_of(*value, path);
        change.parameter = {wire::number_from_json(ends[0], path + "/0", kChangingParameter),
                            wire::number_from_json(ends[1], path + "/1", kChangingParameter)};
    }
    if (const json* value = reader.find("colours")) {
        const std::string path = reader.path_to("colours");
        const json& ends = ends_of(*value, path);
        change.colours = {colours_from(ends[0], path + "/0"),
                          colours_from(ends[1], path + "/1")};
        if ((*change.colours)[0].size() != (*change.colours)[1].size()) {
            throw wire::WireError(wire::ErrorCode::wrong_type, path, wire::quote(*value),
                                  "as many colours at the end as at the beginning");
        }
    }
    if (!change.parameter && !change.colours) {
        throw wire::WireError(wire::ErrorCode::missing_field, reader.path_to("part"),
                              "a part and nothing that changes",
                              "parameter or colours, or both");
    }
    return change;
}

}  // namespace relume::cli
