// What each path answers (protocol/README.md §3).
#pragma once

#include "server/net/base/metrics.h"
#include "server/net/base/readiness.h"
#include "server/net/http/access.h"
#include "server/net/http/http_message.h"
#include "server/net/http/static_files.h"
#include "server/net/library/libraries.h"
#include "server/net/library/scene_library.h"

#include <string>
#include <string_view>

namespace relume::net {

// Thread-safe.
class HttpRoutes {
  public:
    HttpRoutes(const SceneLibrary& scenes,
               const Libraries& libraries,
               const StaticFiles& files,
               const Access& access,
               const Readiness& readiness,
               Metrics& metrics);

    // True if answering may read files or decode an image, which is not for threads that serve
    // sockets.
    [[nodiscard]] static bool takes_long(const HttpRequest& request);
    // Everything but uploads and upgrades.
    [[nodiscard]] HttpReply answer(const HttpRequest& request) const;
    // The name in /session/NAME, or nothing.
    [[nodiscard]] static std::optional<std::string> room_of(const HttpRequest& request);
    [[nodiscard]] static bool is_upload(const HttpRequest& request);

  private:
    [[nodiscard]] HttpReply answer_api(const HttpRequest& request) const;
    [[nodiscard]] HttpReply scenes() const;
    [[nodiscard]] HttpReply environments() const;
    [[nodiscard]] HttpReply materials() const;
    [[nodiscard]] HttpReply picture(std::string_view name, ScenePicture picture) const;
    [[nodiscard]] HttpReply preview(std::string_view name) const;
    [[nodiscard]] HttpReply file(const HttpRequest& request) const;
    [[nodiscard]] HttpReply readyz() const;
    [[nodiscard]] HttpReply metrics() const;

    const SceneLibrary& scenes_;
    const EnvironmentLibrary& environments_;
    const MaterialLibrary& materials_;
    const StaticFiles& files_;
    const Access& access_;
    const Readiness& readiness_;
    Metrics& metrics_;
};

}  // namespace relume::net
