#include "server/net/library/environment_library.h"

#include "protocol/light/procedural_environment.h"
#include "protocol/wire/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace relume::net {

namespace {

// All uses of an upload but the library's own two references.
bool in_use(const std::shared_ptr<Environment>& environment) {
    return environment.use_count() > 2;
}

}  // namespace

EnvironmentLibrary::EnvironmentLibrary(const EnvironmentBounds& bounds)
    : bounds_(bounds), cache_(std::make_shared<ResidentCache>(bounds.cache_bytes)) {
    const std::uint32_t height = light::SkyParameters{}.height;
    for (const std::string_view name : light::procedural_environment_names()) {
        put_locked({.name = std::string(name),
                    .kind = EnvironmentKind::procedural,
                    .width = 2 * height,
                    .height = height},
                   [name] { return light::procedural_environment(name); });
    }
}

void EnvironmentLibrary::put_file(const std::string& name,
                                  std::uint32_t width,
                                  std::uint32_t height,
                                  Environment::Load load) {
    bool replaces = false;
    {
        const std::lock_guard lock(mutex_);
        const auto known = environments_.find(name);
        replaces = known != environments_.end();
        if (replaces && known->second->description().kind != EnvironmentKind::file) {
            throw std::runtime_error(fmt::format("there is a {} environment {} already",
                                                 name_from(known->second->description().kind),
                                                 name));
        }
        put_locked(
            {.name = name, .kind = EnvironmentKind::file, .width = width, .height = height},
            std::move(load));
    }
    if (replaces) {
        tell_replaced(name);
    }
}

void EnvironmentLibrary::remove_file(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto known = environments_.find(name);
    if (known != environments_.end() &&
        known->second->description().kind == EnvironmentKind::file) {
        environments_.erase(known);
    }
}

void EnvironmentLibrary::put_locked(Environment::Description description,
                                    Environment::Load load) {
    std::string name = description.name;
    description.version = ++last_version_;
    environments_.insert_or_assign(
        std::move(name),
        std::make_shared<Environment>(std::move(description), std::move(load), cache_));
}

void EnvironmentLibrary::tell_replaced(const std::string& name) const {
    if (tell_replaced_) {
        tell_replaced_(name);
    }
}

void EnvironmentLibrary::check_upload_name(std::string_view name) const {
    const SharedEnvironment known = find(name);
    if (known && known->description().kind != EnvironmentKind::upload) {
        throw wire::WireError(wire::ErrorCode::unsupported, "name", std::string(name),
                              fmt::format("a name not taken by a {} environment",
                                          name_from(known->description().kind)));
    }
}

void EnvironmentLibrary::add_upload(const std::string& name, light::EnvironmentMap map) {
    check_upload_name(name);
    if (put_upload(name, std::move(map))) {
        tell_replaced(name);
    }
}

bool EnvironmentLibrary::put_upload(const std::string& name, light::EnvironmentMap map) {
    const std::size_t bytes = Environment::bytes_of(map);
    const std::lock_guard lock(mutex_);
    auto environment = std::make_shared<Environment>(
        Environment::Description{.name = name,
                                 .kind = EnvironmentKind::upload,
                                 .width = map.width(),
                                 .height = map.height(),
                                 .version = ++last_version_},
        std::make_shared<const light::EnvironmentMap>(std::move(map)), cache_);
    const auto earlier = std::find_if(uploads_.begin(), uploads_.end(), [&](const Upload& u) {
        return u.environment->description().name == name;
    });
    std::list<Upload> replaced;
    if (earlier != uploads_.end()) {
        upload_bytes_ -= earlier->bytes;
        replaced.splice(replaced.end(), uploads_, earlier);
    }
    try {
        while (!has_room_for_locked(bytes)) {
            drop_unused_upload_locked();
        }
    } catch (const wire::WireError&) {
        for (const Upload& upload : replaced) {
            upload_bytes_ += upload.bytes;
        }
        uploads_.splice(uploads_.begin(), replaced);
        throw;
    }
    uploads_.push_back({.environment = environment, .bytes = bytes});
    upload_bytes_ += bytes;
    environments_.insert_or_assign(name, std::move(environment));
    return !replaced.empty();
}

bool EnvironmentLibrary::has_room_for_locked(std::size_t bytes) const {
    return uploads_.size() < bounds_.uploads &&
           upload_bytes_ + bytes <= bounds_.upload_memory_bytes;
}

void EnvironmentLibrary::drop_unused_upload_locked() {
    const auto unused =
        std::find_if(uploads_.begin(), uploads_.end(),
                     [](const Upload& upload) { return !in_use(upload.environment); });
    if (unused == uploads_.end()) {
        throw wire::WireError(
            wire::ErrorCode::too_many, "name",
            fmt::format("{} uploads of {} bytes in use", uploads_.size(), upload_bytes_),
            fmt::format("at most {} uploads of {} bytes decoded", bounds_.uploads,
                        bounds_.upload_memory_bytes));
    }
    upload_bytes_ -= unused->bytes;
    environments_.erase(unused->environment->description().name);
    uploads_.erase(unused);
}

std::shared_ptr<Environment> EnvironmentLibrary::find(std::string_view name) const {
    const std::lock_guard lock(mutex_);
    const auto found = environments_.find(name);
    return found == environments_.end() ? nullptr : found->second;
}

std::vector<Environment::Description> EnvironmentLibrary::list() const {
    const std::lock_guard lock(mutex_);
    std::vector<Environment::Description> all;
    all.reserve(environments_.size());
    for (const auto& [name, environment] : environments_) {
        all.push_back(environment->description());
    }
    return all;
}

std::size_t EnvironmentLibrary::resident_bytes() const {
    const std::lock_guard lock(mutex_);
    return cache_->bytes() + upload_bytes_;
}

}  // namespace relume::net
