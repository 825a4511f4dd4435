// One named environment: decoded and prefiltered when it is first used.
#pragma once

#include "protocol/light/environment_error.h"
#include "protocol/light/environment_map.h"
#include "protocol/light/prefiltered_environment.h"
#include "server/net/library/resident_cache.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace relume::net {

enum class EnvironmentKind : std::uint8_t { file, procedural, upload };
[[nodiscard]] std::string_view name_from(EnvironmentKind kind);

// Thread-safe. Decoding and prefiltering take up to seconds: not for threads that serve
// sockets. Several callers wait for one decoding.
class Environment {
  public:
    struct Description {
        std::string name;
        EnvironmentKind kind = EnvironmentKind::file;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        // Of the map behind the name; higher than the version of any earlier map of this
        // server.
        std::uint64_t version = 0;
    };
    using Load = std::function<light::EnvironmentMap()>;
    using SharedMap = std::shared_ptr<const light::EnvironmentMap>;
    using SharedPrefiltered = std::shared_ptr<const light::PrefilteredEnvironment>;

    // Loaded by `load` when it is needed, and again after the cache has let go of it.
    Environment(Description description, Load load, std::shared_ptr<ResidentCache> cache);
    // Kept as long as this object.
    Environment(Description description, SharedMap map, std::shared_ptr<ResidentCache> cache);

    [[nodiscard]] const Description& description() const { return description_; }

    // Both throw light::EnvironmentError; a failure is remembered, not tried again.
    [[nodiscard]] SharedPrefiltered prefiltered(std::uint32_t face_resolution);
    // 256×128, tone-mapped.
    [[nodiscard]] std::shared_ptr<const std::string> preview_jpeg();

    // Of a map at full resolution with its pyramid.
    [[nodiscard]] static std::size_t bytes_of(const light::EnvironmentMap& map);

  private:
    [[nodiscard]] SharedMap map_locked();

    const Description description_;
    const Load load_;
    const std::shared_ptr<ResidentCache> cache_;
    std::mutex mutex_;
    SharedMap kept_map_;
    std::weak_ptr<const light::EnvironmentMap> map_;
    std::map<std::uint32_t, std::weak_ptr<const light::PrefilteredEnvironment>> prefiltered_;
    std::shared_ptr<const std::string> preview_;
    std::optional<light::EnvironmentError> failure_;
};

}  // namespace relume::net
