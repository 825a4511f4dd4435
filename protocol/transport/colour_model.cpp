#include "protocol/transport/colour_model.h"

#include "protocol/base/text/strict_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace relume::transport {

using nlohmann::json;

json json_from(const ColourModel& colour) {
    json matrix = json::array();
    for (const auto& row : colour.matrix) {
        matrix.push_back(std::vector<float>(row.begin(), row.begin() + colour.channels));
    }
    return {{"channels", colour.channels}, {"matrix", matrix}};
}

ColourModel colour_model(const ManifestReader& object) {
    ColourModel colour;
    colour.channels = object.integer32("channels", 1, kMaxChannels);
    if (colour.channels == 2) {
        object.fail("channels", "2", "1 or 3");
    }
    const json& matrix = object.member("matrix");
    const bool shaped = matrix.is_array() && matrix.size() == kColours &&
                        std::all_of(matrix.begin(), matrix.end(), [&](const json& row) {
                            return row.is_array() && row.size() == colour.channels &&
                                   std::all_of(row.begin(), row.end(), [](const json& value) {
                                       return is_single(value);
                                   });
                        });
    if (!shaped) {
        object.fail("matrix", text::quote(matrix),
                    fmt::format("3 rows of {} numbers", colour.channels));
    }
    for (std::size_t c = 0; c < kColours; ++c) {
        for (std::size_t k = 0; k < colour.channels; ++k) {
            colour.matrix[c][k] = matrix[c][k].get<float>();
        }
    }
    return colour;
}

}  // namespace relume::transport
