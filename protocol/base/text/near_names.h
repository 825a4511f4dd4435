// What somebody may have meant by a name that does not exist.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relume::text {

// Changes of one character, and exchanges of two neighbours, that make one name of the other,
// upper and lower case being the same; the optimal string alignment distance [Damerau64].
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// At most three of `known` that resemble `name`, nearest first: within a third of its length of
// changes, or beginning or ended by it. Names above 256 bytes resemble nothing.
[[nodiscard]] std::vector<std::string> near_names(std::string_view name,
                                                  std::span<const std::string> known);

// What an error message expects in the place of `name`: "did you mean table or tablet?" where
// some are near, else the known names themselves, at most eight: "one of plane, sphere, table";
// "there are none" without any. `what` names them in the plural, as "scenes": "one of 40
// scenes, such as a, b, c".
[[nodiscard]] std::string expected_name(std::string_view name,
                                        std::span<const std::string> known,
                                        std::string_view what);

}  // namespace relume::text
