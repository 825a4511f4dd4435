// Reading one object of manifest.json: every fault names its place.
#pragma once

#include "protocol/base/text/strict_json.h"
#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <Imath/ImathVec.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace relume::transport {

// Whether a value is a number that single precision holds.
inline bool is_single(const nlohmann::json& value) {
    return value.is_number() &&
           std::abs(value.get<double>()) <= std::numeric_limits<float>::max();
}

// Reads members of one object, naming the place in every complaint.
class ManifestReader {
  public:
    ManifestReader(const nlohmann::json& object, std::string place)
        : object_(object), place_(std::move(place)) {
        if (!object.is_object()) {
            fail("", object.type_name(), "an object");
        }
    }

    // For messages: the file and the way to the object.
    [[nodiscard]] const std::string& place() const { return place_; }
    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const nlohmann::json& member(const char* key) const {
        const auto found = object_.find(key);
        if (found == object_.end()) {
            fail(key, "missing", "a value");
        }
        return *found;
    }
    [[nodiscard]] ManifestReader object(const char* key) const {
        return {member(key), place_ + "." + key};
    }
    [[nodiscard]] std::string string(const char* key) const {
        const nlohmann::json& value = member(key);
        if (!value.is_string()) {
            fail(key, value.type_name(), "a string");
        }
        return value.get<std::string>();
    }
    // An object for people to read: its content is their business.
    [[nodiscard]] nlohmann::json notes(const char* key) const {
        const nlohmann::json& value = member(key);
        if (!value.is_object()) {
            fail(key, value.type_name(), "an object");
        }
        return value;
    }
    [[nodiscard]] std::uint64_t integer(const char* key,
                                        std::uint64_t low,
                                        std::uint64_t high) const {
        const nlohmann::json& value = member(key);
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() < low ||
            value.get<std::uint64_t>() > high) {
            fail(key, text::quote(value), fmt::format("an integer from {} to {}", low, high));
        }
        return value.get<std::uint64_t>();
    }
    [[nodiscard]] std::uint32_t integer32(const char* key,
                                          std::uint32_t low,
                                          std::uint32_t high) const {
        return static_cast<std::uint32_t>(integer(key, low, high));
    }
    [[nodiscard]] std::uint64_t digits(const char* key) const {
        const auto value = checksum_from_text(string(key));
        if (!value) {
            fail(key, text::quote(string(key)), "16 hexadecimal digits");
        }
        return *value;
    }
    [[nodiscard]] double not_negative(const char* key) const {
        const nlohmann::json& value = member(key);
        if (!is_single(value) || value.get<double>() < 0) {
            fail(key, text::quote(value), "a number that is not negative");
        }
        return value.get<double>();
    }
    [[nodiscard]] float number(const char* key) const { return number_from(member(key), key); }
    [[nodiscard]] Imath::V3f vector(const char* key) const {
        const nlohmann::json& value = member(key);
        if (!value.is_array() || value.size() != 3) {
            fail(key, text::quote(value), "three numbers");
        }
        return {number_from(value[0], key), number_from(value[1], key),
                number_from(value[2], key)};
    }
    void expect_text(const char* key, std::string_view expected) const {
        if (string(key) != expected) {
            fail(key, text::quote(string(key)), expected);
        }
    }
    void expect_integer(const char* key, std::uint64_t expected) const {
        [[maybe_unused]] const std::uint64_t value = integer(key, expected, expected);
    }
    [[noreturn]] void fail(std::string_view key,
                           std::string_view found,
                           std::string_view expected) const {
        throw TransportError(fmt::format("{}{}{}: found {}, expected {}", place_,
                                         key.empty() ? "" : ".", key, found, expected));
    }

  private:
    [[nodiscard]] float number_from(const nlohmann::json& value, const char* key) const {
        if (!is_single(value)) {
            fail(key, text::quote(value), "a finite number of single precision");
        }
        return value.get<float>();
    }

    const nlohmann::json& object_;
    std::string place_;
};

}  // namespace relume::transport
