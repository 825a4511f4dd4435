// Reading values out of JSON that a peer sent: every fault is a WireError with its path.
#pragma once

#include "protocol/wire/range.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relume::wire {

// Each throws WireError{wrong_type} or {out_of_range} at `path`.
[[nodiscard]] double number_from_json(const nlohmann::json& value,
                                      const std::string& path,
                                      Range range);
// Takes 30 and 30.0 alike, as JSON knows only one kind of number.
[[nodiscard]] std::uint64_t integer_from_json(const nlohmann::json& value,
                                              const std::string& path,
                                              std::uint64_t lowest,
                                              std::uint64_t highest);
[[nodiscard]] std::vector<double> numbers_from_json(const nlohmann::json& value,
                                                    const std::string& path,
                                                    std::size_t count,
                                                    Range range);
[[nodiscard]] Imath::V3d vector_from_json(const nlohmann::json& value,
                                          const std::string& path,
                                          Range range);
[[nodiscard]] bool flag_from_json(const nlohmann::json& value, const std::string& path);
[[nodiscard]] std::string string_from_json(const nlohmann::json& value,
                                           const std::string& path);
[[nodiscard]] std::vector<std::string> strings_from_json(const nlohmann::json& value,
                                                         const std::string& path);
// Strings that names.h allows as names and as labels.
[[nodiscard]] std::string name_from_json(const nlohmann::json& value, const std::string& path);
[[nodiscard]] std::string label_from_json(const nlohmann::json& value, const std::string& path);

// One JSON object whose keys are asked for one by one. Keeps references to what it is given.
class ObjectReader {
  public:
    // Throws WireError{wrong_type} unless `value` is an object.
    ObjectReader(const nlohmann::json& value, std::string path);

    // Null when the key is absent.
    [[nodiscard]] const nlohmann::json* find(std::string_view key);
    // Throws WireError{missing_field} when the key is absent.
    [[nodiscard]] const nlohmann::json& require(std::string_view key);
    // Throws WireError{unknown_field} for the first key that was not asked for.
    void refuse_other_keys() const;

    [[nodiscard]] std::string path_to(std::string_view key) const;

  private:
    const nlohmann::json& object_;
    std::string path_;
    std::vector<std::string_view> known_keys_;
};

}  // namespace relume::wire
