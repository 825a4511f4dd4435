// The shared cases of protocol/wire/vectors.
#pragma once

#include "protocol/wire/errors.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace relume::wire {

// Whole file NAME.json; throws when it is missing or empty.
[[nodiscard]] nlohmann::json vectors_from_file(const std::string& name);
[[nodiscard]] std::vector<std::byte> bytes_from_hex(std::string_view hex);

// Runs `action` and returns the WireError it throws; throws std::logic_error if it does not.
template <typename Action>
[[nodiscard]] WireError wire_error_of(Action&& action) {
    try {
        static_cast<void>(action());
    } catch (const WireError& error) {
        return error;
    }
    throw std::logic_error("nothing was refused");
}

}  // namespace relume::wire
