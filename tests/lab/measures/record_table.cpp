#include "tests/lab/measures/record_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace relume::lab {
namespace {

std::string text_from_value(const RecordColumn& column, double value) {
    if (std::isnan(value)) {
        return "";
    }
    return column.reproducible ? fmt::format("{}", value) : fmt::format("{:.1f}", value);
}

nlohmann::json json_from_band(const BandRecord& band) {
    return {{"updated", band.updated},
            {"residual_energy", band.residual_energy},
            {"change_energy", band.change_energy}};
}

}  // namespace

std::string csv_from_records(const std::vector<Record>& records) {
    std::string text = "method,image";
    for (const RecordColumn& column : record_columns()) {
        text += fmt::format(",{}", column.name);
    }
    text += '\n';
    for (const Record& record : records) {
        text += fmt::format("{},{}", record.method, record.image);
        for (const RecordColumn& column : record_columns()) {
            text += "," + text_from_value(column, column.value(record));
        }
        text += '\n';
    }
    return text;
}

nlohmann::json json_from_records(const std::vector<Record>& records) {
    nlohmann::json array = nlohmann::json::array();
    for (const Record& record : records) {
        nlohmann::json object{{"method", record.method}, {"image", record.image}};
        for (const RecordColumn& column : record_columns()) {
            // NaN becomes null.
            object[std::string(column.name)] = column.value(record);
        }
        object["bands"] = nlohmann::json::array();
        for (const BandRecord& band : record.bands) {
            object["bands"].push_back(json_from_band(band));
        }
        array.push_back(std::move(object));
    }
    return array;
}

}  // namespace relume::lab
