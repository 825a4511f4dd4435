#include "protocol/wire/stages.h"

#include "protocol/base/text/name_table.h"
#include "protocol/wire/sections/room_sections.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

constexpr text::NameTable<Stage, 4> kStageNames({{
    {Stage::signal, "signal"},
    {Stage::view, "view"},
    {Stage::display, "display"},
    {Stage::policy, "policy"},
}});

}  // namespace

std::string_view name_from(Stage stage) {
    return kStageNames.name(stage);
}

Stages stages_of(const nlohmann::json& patch) {
    Stages stages;
    for_each_section([&](const auto& section, auto) {
        if (patch.contains(fields_of(section).key)) {
            stages |= fields_of(section).stage;
        }
    });
    return stages;
}

}  // namespace relume::wire
