// The names a server knows, and what somebody may have meant by one it does not know.
#pragma once

#include "client/cli/url.h"
#include "protocol/wire/offered_material.h"

#include <string>
#include <vector>

namespace relume::cli {

[[nodiscard]] std::vector<std::string> scenes_of(const Url& server);
[[nodiscard]] std::vector<std::string> environments_of(const Url& server);

// Of those that can be edited in the scene; none where the scene has no such, or the server has
// no such scene.
[[nodiscard]] std::vector<std::string> materials_of(const Url& server,
                                                    const std::string& scene);

// What parts of scenes may be given; none where the server is too old to have such.
[[nodiscard]] std::vector<wire::OfferedMaterial> offered_materials(const Url& server);

// Throws ClientError, naming the scenes that resemble it, unless the server has the scene.
void require_scene(const Url& server, const std::string& scene);

}  // namespace relume::cli
