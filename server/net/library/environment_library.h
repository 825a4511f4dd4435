// The environments a server offers: by formula, from the operator's folder, and uploaded.
#pragma once

#include "server/net/library/environment.h"
#include "server/net/library/resident_cache.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

struct EnvironmentBounds {
    std::size_t uploads = 32;
    std::size_t upload_memory_bytes = std::size_t{2} << 30;  // all uploads, decoded
    std::size_t cache_bytes = std::size_t{1} << 30;  // decoded files and prefiltered maps
};

// Thread-safe.
class EnvironmentLibrary {
  public:
    // Offers the procedural environments.
    explicit EnvironmentLibrary(const EnvironmentBounds& bounds);

    // Offers a map from a file, loaded when it is needed, in place of an earlier file of this
    // name. Throws std::runtime_error when the name is taken by what is no file.
    void put_file(const std::string& name,
                  std::uint32_t width,
                  std::uint32_t height,
                  Environment::Load load);
    // Ends the offer. Rooms that use the map keep it.
    void remove_file(const std::string& name);

    // Offers an uploaded map, in place of an earlier upload of this name. When there are too
    // many, those that no room uses go first. Throws WireError: unsupported when the name is
    // taken by what is no upload, too_many when nothing can be dropped.
    void add_upload(const std::string& name, light::EnvironmentMap map);
    // `tell` is called, without locks held, after a map has taken the place of an earlier one.
    // Has to be set before that can happen.
    void when_replaced(std::function<void(const std::string& name)> tell) {
        tell_replaced_ = std::move(tell);
    }
    // Throws where add_upload would refuse the name.
    void check_upload_name(std::string_view name) const;

    // By name; null when there is none. The result stays usable as long as it is held.
    [[nodiscard]] std::shared_ptr<Environment> find(std::string_view name) const;
    // In the order of their names.
    [[nodiscard]] std::vector<Environment::Description> list() const;
    // Bytes of all maps that are kept in memory, but for those that only rooms hold.
    [[nodiscard]] std::size_t resident_bytes() const;

  private:
    using SharedEnvironment = std::shared_ptr<Environment>;
    struct Upload {
        SharedEnvironment environment;
        std::size_t bytes;
    };

    void put_locked(Environment::Description description, Environment::Load load);
    void tell_replaced(const std::string& name) const;
    // True when there was an earlier one.
    bool put_upload(const std::string& name, light::EnvironmentMap map);
    void drop_unused_upload_locked();
    [[nodiscard]] bool has_room_for_locked(std::size_t bytes) const;

    const EnvironmentBounds bounds_;
    const std::shared_ptr<ResidentCache> cache_;
    std::function<void(const std::string&)> tell_replaced_;
    mutable std::mutex mutex_;
    std::map<std::string, SharedEnvironment, std::less<>> environments_;
    std::uint64_t last_version_ = 0;
    std::list<Upload> uploads_;  // the oldest in front
    std::size_t upload_bytes_ = 0;
};

}  // namespace relume::net
