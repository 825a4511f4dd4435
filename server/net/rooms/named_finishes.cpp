#include "server/net/rooms/named_finishes.h"

#include "protocol/base/text/near_names.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace relume::net {
namespace {

using wire::ErrorCode;
using wire::WireError;

void require_part(const wire::SceneSummary& scene,
                  const std::string& id,
                  const std::string& path) {
    std::vector<std::string> known;
    for (const wire::ScenePart& part : scene.parts) {
        known.push_back(part.id);
    }
    if (std::find(known.begin(), known.end(), id) == known.end()) {
        throw WireError(ErrorCode::unknown_name, path, id,
                        text::expected_name(id, known, "parts"));
    }
}

MaterialLibrary::SharedFamily find_material(const MaterialLibrary& library,
                                            const std::string& name,
                                            std::uint32_t face_resolution,
                                            const std::string& path) {
    if (MaterialLibrary::SharedFamily family = library.find(name, face_resolution)) {
        return family;
    }
    std::vector<std::string> known;
    for (const MaterialLibrary::SharedFamily& family : library.list()) {
        if (family->first().face_resolution() == face_resolution) {
            known.push_back(family->name);
        } else if (family->name == name) {
            throw WireError(
                ErrorCode::unknown_name, path, name,
                fmt::format("a material of {0}×{0} texels a face, as the scene's visibility "
                            "has; this one has {1}×{1}",
                            face_resolution, family->first().face_resolution()));
        }
    }
    throw WireError(ErrorCode::unknown_name, path, name,
                    text::expected_name(name, known, "materials"));
}

void require_fits(const wire::Finish& finish,
                  const MaterialFamily& family,
                  const std::string& path) {
    const std::size_t lobes = family.first().colours().size();
    if (finish.colours && finish.colours->rows() != lobes) {
        throw WireError(ErrorCode::out_of_range, wire::pointer_step(path, "colours"),
                        fmt::format("{} colours", finish.colours->rows()),
                        fmt::format("{}, one a lobe of {}", lobes, family.name));
    }
    if (!finish.parameter) {
        return;
    }
    const std::string of_number = wire::pointer_step(path, "parameter");
    if (!family.parameter) {
        throw WireError(ErrorCode::unsupported, of_number, fmt::format("{}", *finish.parameter),
                        fmt::format("none: {} is one material and no family", family.name));
    }
    const double least = family.steps.front().number;
    const double most = family.steps.back().number;
    if (*finish.parameter < least || *finish.parameter > most) {
        throw WireError(ErrorCode::out_of_range, of_number,
                        fmt::format("{}", *finish.parameter),
                        fmt::format("{} from {} to {}", *family.parameter, least, most));
    }
}

}  // namespace

nlohmann::json with_fresh_finishes(const nlohmann::json& patch, const wire::Finishes& before) {
    const std::string section(wire::kFinishes.entry.key);
    if (!patch.is_object() || !patch.contains(section) || !patch[section].is_object()) {
        return patch;
    }
    nlohmann::json whole = patch;
    for (auto& [id, change] : whole[section].items()) {
        const auto known = before.find(id);
        if (known == before.end() || !change.is_object() || !change.contains("material") ||
            change["material"] == known->second.material) {
            continue;
        }
        for (const char* const key : {"parameter", "colours"}) {
            if (!change.contains(key)) {
                change[key] = nullptr;
            }
        }
    }
    return whole;
}

NamedFinishes finishes_after(const NamedFinishes& before,
                             const wire::RoomState& state,
                             const nlohmann::json& patch,
                             const wire::SceneSummary& scene,
                             const MaterialLibrary& library) {
    const std::string section(wire::kFinishes.entry.key);
    const auto changes = patch.find(section);
    if (changes == patch.end()) {
        return before;
    }
    NamedFinishes after = before;
    for (const auto& [id, change] : changes->items()) {
        const auto finish = state.finishes.find(id);
        if (finish == state.finishes.end()) {
            after.erase(id);
            continue;
        }
        const std::string path = wire::pointer_step("/" + section, id);
        require_part(scene, id, path);
        auto& family = after[id];
        if (!family || change.contains("material")) {
            family = find_material(library, finish->second.material,
                                   scene.visibility_resolution.value_or(0),
                                   wire::pointer_step(path, "material"));
        }
        require_fits(finish->second, *family, path);
    }
    return after;
}

}  // namespace relume::net
