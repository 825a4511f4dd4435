// Materials given to parts of a scene, as command-line options.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::cli {

// The section `finishes` of a patch, of options "PART=MATERIAL[@NUMBER][:R,G,B …]": a part of
// the scene, a material of the server, the number of a family, and a colour for each lobe. An
// empty object when nothing is asked for. Throws program::UsageError for an option whose form
// is wrong; names, numbers and how many colours there are, are for the server to judge.
[[nodiscard]] nlohmann::json finishes_from_options(const std::vector<std::string>& options);

}  // namespace relume::cli
