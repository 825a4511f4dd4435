// The names a server knows, and what somebody may have meant by one it does not know.
#pragma once

#include "client/cli/url.h"

#include <string>
#include <vector>

namespace relume::cli {

[[nodiscard]] std::vector<std::string> scenes_of(const Url& server);
[[nodiscard]] std::vector<std::string> environments_of(const Url& server);

// Throws ClientError, naming the scenes that resemble it, unless the server has the scene.
void require_scene(const Url& server, const std::string& scene);

}  // namespace relume::cli
