#include "protocol/wire/stages.h"

#include "protocol/base/text/name_table.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

constexpr text::NameTable<Stage, 4> kStageNames({{
    {Stage::signal, "signal"},
    {Stage::view, "view"},
    {Stage::display, "display"},
    {Stage::policy, "policy"},
}});

struct SectionStage {
    std::string_view section;
    Stage stage;
};

constexpr SectionStage kSectionStages[] = {
    {"environment", Stage::signal}, {"blend", Stage::signal},    {"rotation", Stage::signal},
    {"lights", Stage::signal},      {"background", Stage::view}, {"strategy", Stage::policy},
    {"budget", Stage::policy},      {"display", Stage::display},
};

}  // namespace

std::string_view name_from(Stage stage) {
    return kStageNames.name(stage);
}

Stages stages_of(const nlohmann::json& patch) {
    Stages stages;
    for (const auto& [section, stage] : kSectionStages) {
        if (patch.contains(section)) {
            stages |= stage;
        }
    }
    return stages;
}

}  // namespace relume::wire
