#include "server/net/library/environment.h"

#include "protocol/light/preview.h"
#include "server/net/images/jpeg_encoder.h"

#include <utility>

namespace relume::net {

namespace {

constexpr int kPreviewQuality = 85;

std::size_t bytes_of_texels(const light::PrefilteredEnvironment& environment) {
    return environment.padded_texels().size_bytes();
}

}  // namespace

std::string_view name_from(EnvironmentKind kind) {
    switch (kind) {
        case EnvironmentKind::file:
            return "file";
        case EnvironmentKind::procedural:
            return "procedural";
        case EnvironmentKind::upload:
            break;
    }
    return "upload";
}

std::size_t Environment::bytes_of(const light::EnvironmentMap& map) {
    std::size_t bytes = 0;
    for (const light::EnvironmentMap::Level& level : map.levels()) {
        bytes += level.rgb.size() * sizeof(float);
    }
    return bytes;
}

Environment::Environment(Description description,
                         Load load,
                         std::shared_ptr<ResidentCache> cache)
    : description_(std::move(description)), load_(std::move(load)), cache_(std::move(cache)) {}

Environment::Environment(Description description,
                         SharedMap map,
                         std::shared_ptr<ResidentCache> cache)
    : description_(std::move(description)),
      cache_(std::move(cache)),
      kept_map_(map),
      map_(map) {}

Environment::SharedMap Environment::map_locked() {
    if (SharedMap map = map_.lock()) {
        return map;
    }
    if (failure_) {
        throw light::EnvironmentError(*failure_);
    }
    try {
        auto map = std::make_shared<const light::EnvironmentMap>(load_());
        map_ = map;
        cache_->keep(map, bytes_of(*map));
        return map;
    } catch (const light::EnvironmentError& failure) {
        failure_ = failure;
        throw;
    }
}

Environment::SharedPrefiltered Environment::prefiltered(std::uint32_t face_resolution) {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const light::PrefilteredEnvironment>& known = prefiltered_[face_resolution];
    SharedPrefiltered environment = known.lock();
    if (!environment) {
        environment = std::make_shared<const light::PrefilteredEnvironment>(map_locked(),
                                                                            face_resolution);
        known = environment;
    }
    // It keeps its source alive, which may long have left the cache: both count.
    cache_->keep(environment, bytes_of_texels(*environment) + bytes_of(environment->source()));
    return environment;
}

std::shared_ptr<const std::string> Environment::preview_jpeg() {
    const std::lock_guard lock(mutex_);
    if (!preview_) {
        const light::PreviewImage preview = light::make_preview(*map_locked());
        JpegEncoder encoder;
        const auto bytes =
            encoder.encode(preview.rgb, preview.width, preview.height, kPreviewQuality);
        preview_ = std::make_shared<const std::string>(
            reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    return preview_;
}

}  // namespace relume::net
