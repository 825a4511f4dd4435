#include "protocol/wire/patch_section.h"

#include <algorithm>
#include <cmath>

namespace relume::wire {

using nlohmann::json;

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

void PatchSection::take_number(const char* key, Range range, double& target) {
    if (const json* value = reader_.find(key)) {
        target = number_from_json(*value, reader_.path_to(key), range);
        normalised_[key] = target;
    }
}

void PatchSection::take_flag(const char* key, bool& target) {
    if (const json* value = reader_.find(key)) {
        target = flag_from_json(*value, reader_.path_to(key));
        normalised_[key] = target;
    }
}

void PatchSection::take_vector(const char* key, Range range, Imath::V3d& target) {
    if (const json* value = reader_.find(key)) {
        target = vector_from_json(*value, reader_.path_to(key), range);
        normalised_[key] = *value;
    }
}

void PatchSection::take_direction(const char* key, Imath::V3d& target) {
    if (const json* value = reader_.find(key)) {
        const std::string path = reader_.path_to(key);
        std::vector<double> numbers = numbers_from_json(*value, path, 3, kAnyNumber);
        normalise(numbers, path, *value);
        target = {numbers[0], numbers[1], numbers[2]};
        normalised_[key] = std::move(numbers);
    }
}

void PatchSection::take_name(const char* key, std::string& target) {
    if (const json* value = reader_.find(key)) {
        target = name_from_json(*value, reader_.path_to(key));
        normalised_[key] = target;
    }
}

void PatchSection::take_name(const char* key, std::optional<std::string>& target) {
    if (const json* value = reader_.find(key)) {
        target = value->is_null() ? std::nullopt
                                  : std::optional(name_from_json(*value, reader_.path_to(key)));
        normalised_[key] = *value;
    }
}

void PatchSection::take_label(const char* key, std::optional<std::string>& target) {
    if (const json* value = reader_.find(key)) {
        target = value->is_null()
                     ? std::nullopt
                     : std::optional(label_from_json(*value, reader_.path_to(key)));
        normalised_[key] = *value;
    }
}

json PatchSection::finish() {
    reader_.refuse_other_keys();
    return std::move(normalised_);
}

}  // namespace relume::wire
