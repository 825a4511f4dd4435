#include "tests/lab/commands/markdown_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relume::lab {
namespace {

std::string cell_of(const nlohmann::json& value) {
    if (value.is_number_float()) {
        return fmt::format("{:.3g}", value.get<double>());
    }
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

void print_markdown_table(const std::vector<MarkdownColumn>& columns,
                          const nlohmann::json& rows) {
    std::string head = "\n|";
    std::string line = "|";
    for (const MarkdownColumn& column : columns) {
        head += fmt::format(" {} |", column.title);
        line += "---|";
    }
    fmt::print("{}\n{}\n", head, line);
    for (const nlohmann::json& row : rows) {
        std::string cells = "|";
        for (const MarkdownColumn& column : columns) {
            cells += fmt::format(
                " {} |", cell_of(row.at(nlohmann::json::json_pointer("/" + column.key))));
        }
        fmt::print("{}\n", cells);
    }
}

}  // namespace relume::lab
