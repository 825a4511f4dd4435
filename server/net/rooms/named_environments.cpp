#include "server/net/rooms/named_environments.h"

#include "protocol/base/text/near_names.h"
#include "protocol/wire/errors.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace relume::net {

NamedEnvironments environments_after(const NamedEnvironments& before,
                                     const wire::RoomState& state,
                                     const nlohmann::json& patch,
                                     const EnvironmentLibrary& library) {
    const auto names_one = [&patch](const char* key) {
        const auto found = patch.find(key);
        return found != patch.end() && found->is_object() && found->contains("name");
    };
    const auto named = [&library](const std::string& name, const char* path) {
        std::shared_ptr<Environment> environment = library.find(name);
        if (!environment) {
            std::vector<std::string> known;
            for (const auto& other : library.list()) {
                known.push_back(other.name);
            }
            throw wire::WireError(wire::ErrorCode::unknown_name, path, name,
                                  text::expected_name(name, known, "environments"));
        }
        return environment;
    };
    NamedEnvironments after = before;
    if (names_one("environment")) {
        after.environment = named(state.environment.name, "/environment/name");
    }
    if (!state.blend.name) {
        after.blend = nullptr;
    } else if (names_one("blend")) {
        after.blend = named(*state.blend.name, "/blend/name");
    }
    return after;
}

}  // namespace relume::net
