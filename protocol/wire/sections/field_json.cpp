#include "protocol/wire/sections/field_json.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/object_reader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(),
                           std::numeric_limits<double>::max()};

std::vector<double> unit_numbers_from_json(const json& value,
                                           const std::string& path,
                                           std::size_t count) {
    std::vector<double> numbers = numbers_from_json(value, path, count, kAnyNumber);
    normalise(numbers, path, value);
    return numbers;
}

std::string word_from_json(const FieldRule& rule, const json& value, const std::string& path) {
    std::string word = string_from_json(value, path);
    if (std::find(rule.words.begin(), rule.words.end(), word) == rule.words.end()) {
        std::string expected = "one of ";
        for (const std::string_view known : rule.words) {
            expected.append(expected.back() == ' ' ? "" : ", ").append(known);
        }
        throw WireError(ErrorCode::out_of_range, path, quote(value), std::move(expected));
    }
    return word;
}

json json_from_table(const NumberTable& table) {
    json rows = json::array();
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto* const first = &table.numbers[row * table.columns];
        rows.push_back(std::vector<double>(first, first + table.columns));
    }
    return rows;
}

NumberTable table_from_json(const FieldRule& rule, const json& value, const std::string& path) {
    const TableRule& shape = rule.table;
    if (!value.is_array()) {
        throw WireError(ErrorCode::wrong_type, path, quote(value),
                        "an array of arrays of numbers");
    }
    if (value.size() < shape.least_rows || value.size() > shape.most_rows) {
        const std::string least = std::to_string(shape.least_rows);
        throw WireError(
            ErrorCode::out_of_range, path, "an array of " + std::to_string(value.size()),
            shape.least_rows == shape.most_rows
                ? "an array of " + least
                : "an array of " + least + " to " + std::to_string(shape.most_rows));
    }
    NumberTable table{.columns = shape.columns, .numbers = {}};
    for (std::size_t row = 0; row < value.size(); ++row) {
        const std::vector<double> numbers = numbers_from_json(
            value[row], pointer_step(path, std::to_string(row)), shape.columns, rule.range);
        table.numbers.insert(table.numbers.end(), numbers.begin(), numbers.end());
    }
    return table;
}

}  // namespace

json json_from_value(const FieldValue& value) {
    return std::visit(
        [](const auto& plain) -> json {
            using Type = std::decay_t<decltype(plain)>;
            if constexpr (std::is_same_v<Type, std::monostate>) {
                return nullptr;
            } else if constexpr (std::is_same_v<Type, Imath::V3d>) {
                return {plain.x, plain.y, plain.z};
            } else if constexpr (std::is_same_v<Type, Imath::Quatd>) {
                return {plain.r, plain.v.x, plain.v.y, plain.v.z};
            } else if constexpr (std::is_same_v<Type, NumberTable>) {
                return json_from_table(plain);
            } else {
                return plain;
            }
        },
        value);
}

FieldValue value_from_json(const FieldRule& rule, const json& value, const std::string& path) {
    if (value.is_null() && rule.presence == Presence::optional) {
        return {};
    }
    switch (rule.kind) {
        case FieldKind::number:
            return number_from_json(value, path, rule.range);
        case FieldKind::integer:
            return static_cast<std::uint32_t>(
                integer_from_json(value, path, static_cast<std::uint64_t>(rule.range.lowest),
                                  static_cast<std::uint64_t>(rule.range.highest)));
        case FieldKind::flag:
            return flag_from_json(value, path);
        case FieldKind::triple:
            return vector_from_json(value, path, rule.range);
        case FieldKind::direction: {
            const std::vector<double> v = unit_numbers_from_json(value, path, 3);
            return Imath::V3d(v[0], v[1], v[2]);
        }
        case FieldKind::quaternion: {
            const std::vector<double> q = unit_numbers_from_json(value, path, 4);
            return Imath::Quatd(q[0], q[1], q[2], q[3]);
        }
        case FieldKind::name:
            return name_from_json(value, path);
        case FieldKind::label:
            return label_from_json(value, path);
        case FieldKind::word:
            return word_from_json(rule, value, path);
        case FieldKind::table:
            return table_from_json(rule, value, path);
    }
    return {};
}

json normal_form(const FieldRule& rule, const FieldValue& value, const json& stated) {
    const bool is_plain = rule.kind == FieldKind::triple || rule.kind == FieldKind::table;
    return is_plain ? stated : json_from_value(value);
}

// Scales first: the squares of 1e300 have no double.
void normalise(std::vector<double>& numbers, const std::string& path, const json& value) {
    const double largest =
        std::abs(*std::max_element(numbers.begin(), numbers.end(), [](double a, double b) {
            return std::abs(a) < std::abs(b);
        }));
    if (largest == 0) {
        throw WireError(ErrorCode::out_of_range, path, quote(value) + ", all of them zero",
                        "numbers that are not all zero");
    }
    const auto length_of = [&] {
        double squares = 0;
        for (const double x : numbers) {
            squares += x * x;
        }
        return std::sqrt(squares);
    };
    constexpr double kUnitTolerance = 1e-14;
    if (largest <= 1 && std::abs(length_of() - 1) <= kUnitTolerance) {
        return;
    }
    for (double& x : numbers) {
        x /= largest;
    }
    const double length = length_of();
    for (double& x : numbers) {
        x /= length;
    }
}

}  // namespace relume::wire
