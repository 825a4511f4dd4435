// One object of an edit's patch: reads fields into the state and records them as normalised.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/object_reader.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace relume::wire {

inline constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(),
                                  std::numeric_limits<double>::max()};
inline constexpr Range kGain{0, 1e6};
inline constexpr Range kColour{0, 1e4};
inline constexpr Range kExposureStops{-20, 20};

// Divides `numbers` by their length unless that is one already to rounding, so that normalising
// twice gives the same bits as normalising once. Throws WireError{out_of_range} at `path`,
// quoting `value`, where all are zero.
void normalise(std::vector<double>& numbers,
               const std::string& path,
               const nlohmann::json& value);

// Each take_… leaves its target alone where the patch has no such key, and throws WireError
// where the value does not fit. Keeps a reference to the patch.
class PatchSection {
  public:
    PatchSection(const nlohmann::json& patch, std::string path)
        : reader_(patch, std::move(path)) {}

    void take_number(const char* key, Range range, double& target);
    void take_flag(const char* key, bool& target);
    void take_vector(const char* key, Range range, Imath::V3d& target);
    // Normalised to unit length.
    void take_direction(const char* key, Imath::V3d& target);
    // A name as names.h allows.
    void take_name(const char* key, std::string& target);
    // Null takes the name away.
    void take_name(const char* key, std::optional<std::string>& target);
    // A label as names.h allows; null takes it away.
    void take_label(const char* key, std::optional<std::string>& target);
    template <typename Enum, std::size_t Count>
    void take_word(const char* key, const text::NameTable<Enum, Count>& names, Enum& target) {
        if (const nlohmann::json* value = reader_.find(key)) {
            const std::string path = reader_.path_to(key);
            const auto word = names.value(string_from_json(*value, path));
            if (!word) {
                throw WireError(ErrorCode::out_of_range, path, quote(*value),
                                names.alternatives());
            }
            target = *word;
            normalised_[key] = *value;
        }
    }

    [[nodiscard]] ObjectReader& reader() { return reader_; }
    void record(const char* key, nlohmann::json value) { normalised_[key] = std::move(value); }
    // All fields have been asked for; the rest is unknown.
    [[nodiscard]] nlohmann::json finish();

  private:
    ObjectReader reader_;
    nlohmann::json normalised_ = nlohmann::json::object();
};

}  // namespace relume::wire
