#include "protocol/wire/object_reader.h"

#include "protocol/base/text/names.h"
#include "protocol/base/text/near_names.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace relume::wire {
namespace {

using nlohmann::json;

// As JSON prints it: 0.05 and not 0.050000.
std::string text_from_number(double number) {
    return json(number).dump();
}

std::string text_from_range(Range range) {
    return range.lowest < -1e300 && range.highest > 1e300
               ? "a number"
               : "a number " + text_from_number(range.lowest) + " … " +
                     text_from_number(range.highest);
}

[[noreturn]] void refuse_type(const json& value,
                              const std::string& path,
                              std::string expected) {
    throw WireError(ErrorCode::wrong_type, path, quote(value), std::move(expected));
}

std::string ruled_string_from_json(const json& value,
                                   const std::string& path,
                                   bool (*is_allowed)(std::string_view),
                                   std::string expected) {
    if (!value.is_string()) {
        refuse_type(value, path, std::move(expected));
    }
    auto text = value.get<std::string>();
    if (!is_allowed(text)) {
        throw WireError(ErrorCode::out_of_range, path, quote(value), std::move(expected));
    }
    return text;
}

}  // namespace

double number_from_json(const json& value, const std::string& path, Range range) {
    if (!value.is_number()) {
        refuse_type(value, path, text_from_range(range));
    }
    const auto number = value.get<double>();
    if (!(number >= range.lowest && number <= range.highest)) {
        throw WireError(ErrorCode::out_of_range, path, quote(value), text_from_range(range));
    }
    return number;
}

std::uint64_t integer_from_json(const json& value,
                                const std::string& path,
                                std::uint64_t lowest,
                                std::uint64_t highest) {
    const auto expected = [&] {
        return "an integer " + std::to_string(lowest) + " … " + std::to_string(highest);
    };
    if (!value.is_number()) {
        refuse_type(value, path, expected());
    }
    const auto number = value.get<double>();
    if (number != std::floor(number)) {
        refuse_type(value, path, expected());
    }
    // All bounds are below 2^53, where doubles and integers agree.
    if (!(number >= static_cast<double>(lowest) && number <= static_cast<double>(highest))) {
        throw WireError(ErrorCode::out_of_range, path, quote(value), expected());
    }
    return static_cast<std::uint64_t>(number);
}

std::vector<double> numbers_from_json(const json& value,
                                      const std::string& path,
                                      std::size_t count,
                                      Range range) {
    if (!value.is_array() || value.size() != count) {
        refuse_type(value, path, "an array of " + std::to_string(count) + " numbers");
    }
    std::vector<double> numbers;
    numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        numbers.push_back(
            number_from_json(value[i], pointer_step(path, std::to_string(i)), range));
    }
    return numbers;
}

Imath::V3d vector_from_json(const json& value, const std::string& path, Range range) {
    const std::vector<double> numbers = numbers_from_json(value, path, 3, range);
    return {numbers[0], numbers[1], numbers[2]};
}

bool flag_from_json(const json& value, const std::string& path) {
    if (!value.is_boolean()) {
        refuse_type(value, path, "true or false");
    }
    return value.get<bool>();
}

std::string string_from_json(const json& value, const std::string& path) {
    if (!value.is_string()) {
        refuse_type(value, path, "a string");
    }
    return value.get<std::string>();
}

std::vector<std::string> strings_from_json(const json& value, const std::string& path) {
    if (!value.is_array()) {
        throw WireError(ErrorCode::wrong_type, path, quote(value), "an array of strings");
    }
    std::vector<std::string> strings;
    for (std::size_t i = 0; i < value.size(); ++i) {
        strings.push_back(string_from_json(value[i], pointer_step(path, std::to_string(i))));
    }
    return strings;
}

std::string name_from_json(const json& value, const std::string& path) {
    return ruled_string_from_json(value, path, text::is_name,
                                  "a name: " + std::string(text::kNameRule));
}

std::string label_from_json(const json& value, const std::string& path) {
    return ruled_string_from_json(value, path, text::is_label,
                                  "a label: " + std::string(text::kLabelRule));
}

ObjectReader::ObjectReader(const json& value, std::string path)
    : object_(value), path_(std::move(path)) {
    if (!value.is_object()) {
        refuse_type(value, path_, "an object");
    }
}

const json* ObjectReader::find(std::string_view key) {
    known_keys_.push_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

const json& ObjectReader::require(std::string_view key) {
    const json* value = find(key);
    if (value == nullptr) {
        throw WireError(ErrorCode::missing_field, path_to(key), "nothing",
                        "the field \"" + std::string(key) + "\"");
    }
    return *value;
}

void ObjectReader::refuse_other_keys() const {
    for (const auto& [key, value] : object_.items()) {
        if (std::find(known_keys_.begin(), known_keys_.end(), key) != known_keys_.end()) {
            continue;
        }
        std::string expected = known_keys_.empty() ? "no field" : "one of";
        for (const std::string_view known : known_keys_) {
            expected.append(" ").append(known);
        }
        if (const auto near = text::near_names(
                key, std::vector<std::string>(known_keys_.begin(), known_keys_.end()));
            !near.empty()) {
            expected += "; did you mean " + near.front() + "?";
        }
        throw WireError(ErrorCode::unknown_field, path_to(key), quote(json(key)),
                        std::move(expected));
    }
}

std::string ObjectReader::path_to(std::string_view key) const {
    return pointer_step(path_, key);
}

}  // namespace relume::wire
