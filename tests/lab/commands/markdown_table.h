// Figures as a table that can stand in a README.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::lab {

struct MarkdownColumn {
    std::string title;
    std::string key;  // of a row's value; OBJECT/KEY of one inside another
};

// Prints a line for each of the objects in `rows`, numbers to three digits.
void print_markdown_table(const std::vector<MarkdownColumn>& columns,
                          const nlohmann::json& rows);

}  // namespace relume::lab
