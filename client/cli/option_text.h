// What options of several kinds are written in: lists, numbers, and JSON or a file with it.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace relume::cli {

// What a server takes in one message by default.
inline constexpr std::size_t kMaxOptionJsonBytes = std::size_t{64} << 10;

// `count` numbers with commas between them. Throws program::UsageError that says which `form`
// was expected.
[[nodiscard]] std::vector<double> numbers_from_option(std::string_view text,
                                                      std::size_t count,
                                                      std::string_view option,
                                                      std::string_view form);

struct OptionJson {
    nlohmann::json value;
    std::string source;  // the option, or the file
};

// JSON, or what the file of `@FILE` holds. Throws ClientError with line and column of a fault.
[[nodiscard]] OptionJson json_from_option(const std::string& text_or_file,
                                          const std::string& option);

}  // namespace relume::cli
