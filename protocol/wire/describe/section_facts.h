// The descriptions of all sections as plain values, for who writes them down.
#pragma once

#include "protocol/wire/sections/field.h"
#include "protocol/wire/stages.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace relume::wire {

struct SectionFacts {
    std::string_view key;
    Stage stage;
    std::string_view meaning;
    std::string_view noun;  // of one entry, where the section holds entries by id
    std::vector<FieldRule> fields;
    std::vector<FieldRule> spelled;  // numbers a patch may state in place of the fields
    nlohmann::json defaults;         // by key; null for what is not there
};

// In the order of the contract.
[[nodiscard]] std::vector<SectionFacts> section_facts();

// 0.05, 393216, 1e6: as short as it reads.
[[nodiscard]] std::string text_from_number(double number);

}  // namespace relume::wire
