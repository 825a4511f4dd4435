#include "server/net/server.h"

#include "protocol/base/files/atomic_file.h"
#include "server/engine/sums/band_sums.h"
#include "server/net/http/access.h"
#include "server/net/http/decoder_check.h"
#include "server/net/http/http_routes.h"
#include "server/net/http/static_files.h"
#include "server/net/http/upload.h"
#include "server/net/library/environment_folder.h"
#include "server/net/library/folder_watcher.h"
#include "server/net/rooms/worker_pool.h"
#include "server/net/sockets/listener.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace relume::net {

namespace asio = boost::asio;

namespace {

// Threads for previews and thumbnails, besides one for each upload being decoded.
constexpr std::size_t kPreviewThreads = 2;
constexpr std::chrono::milliseconds kDrainPoll{5};

StaticFiles files_from(const std::filesystem::path& web_root) {
    return web_root.empty() ? StaticFiles() : StaticFiles(web_root);
}

// Refreshed once; throws std::runtime_error if it cannot be read.
std::optional<EnvironmentFolder> folder_of(EnvironmentLibrary& library,
                                           const Configuration& configuration) {
    std::optional<EnvironmentFolder> folder;
    if (!configuration.environments.empty()) {
        folder.emplace(library, configuration.environments, configuration.centre);
        folder->refresh();
    }
    return folder;
}

UploadOptions upload_options_from(const Configuration& configuration) {
    return {.file_bytes = configuration.limits.upload_bytes,
            .texels = configuration.connection.upload_texels,
            .concurrent = configuration.connection.concurrent_uploads,
            .per_address = configuration.connection.uploads_per_address,
            .memory_bytes = configuration.environment_bounds.upload_memory_bytes,
            .decoder = configuration.decoder};
}

}  // namespace

// In the order in which they need one another; they die in the opposite one.
struct Server::Parts {
    explicit Parts(const Configuration& c)
        : configuration(c),
          environments(c.environment_bounds),
          materials(c.material_cache_bytes),
          environment_folder(folder_of(environments, c)),
          files(files_from(c.web_root)),
          access(
              c.token,
              OriginPolicy(c.allow_origins),
              HostPolicy(c.listen, endpoint_from_address(c.listen).address(), c.allow_hosts)),
          proxies(c.trusted_proxies),
          io(static_cast<int>(c.io_threads)),
          keep_running(io.get_executor()),
          workers(c.workers, {.edits = 1, .refinements = engine::kMaxBatchMembers}),
          encoders(c.workers, {}),
          rooms(std::make_shared<Rooms>(scenes,
                                        Libraries{environments, materials},
                                        RoomThreads{workers, encoders},
                                        metrics,
                                        c.rooms)),
          routes(scenes, Libraries{environments, materials}, files, access, readiness, metrics),
          uploads(environments, access, upload_options_from(c)),
          slow_requests(kPreviewThreads + c.connection.concurrent_uploads),
          services{routes,
                   uploads,
                   *rooms,
                   access,
                   proxies,
                   readiness,
                   metrics,
                   configuration.limits,
                   configuration.connection,
                   slow_requests},
          listener(io, endpoint_from_address(c.listen)) {
        environments.when_replaced(
            [this](const std::string& name) { rooms->environment_replaced(name); });
    }

    const Configuration configuration;
    Metrics metrics;
    Readiness readiness;
    SceneLibrary scenes;
    EnvironmentLibrary environments;
    MaterialLibrary materials;
    std::optional<EnvironmentFolder> environment_folder;
    StaticFiles files;
    Access access;
    TrustedProxies proxies;
    // Outlives all that holds one of its executors: outboxes in rooms, handlers of slow
    // requests.
    asio::io_context io;
    asio::executor_work_guard<asio::io_context::executor_type> keep_running;
    WorkerPool workers;
    WorkerPool encoders;
    std::shared_ptr<Rooms> rooms;
    HttpRoutes routes;
    Uploads uploads;
    asio::thread_pool slow_requests;
    ConnectionServices services;
    Listener listener;
    std::vector<std::jthread> io_threads;
    bool folders_are_readable = true;  // at the last look
    std::optional<FolderWatcher> watcher;
    bool drained = false;

    void look(Patience patience, const std::stop_token& stop);
    void scenes_are_open();
    void count_scenes();
    void warm_up();
    void wait_for(Clock::time_point deadline, const std::function<bool()>& done) const;
};

// The first look opens the scenes; each later one follows what has changed.
void Server::Parts::look(Patience patience, const std::stop_token& stop) {
    bool scenes_changed = false;
    try {
        scenes_changed = scenes.refresh(configuration.scenes, patience, stop);
        if (environment_folder && readiness.phase() != Readiness::Phase::starting) {
            environment_folder->refresh(patience);
        }
        if (!configuration.materials.empty()) {
            materials.refresh(configuration.materials, patience);
        }
        folders_are_readable = true;
    } catch (const std::exception& failure) {
        if (std::exchange(folders_are_readable, false)) {
            spdlog::error("folder_unreadable reason={:?}", failure.what());
        }
    }
    if (stop.stop_requested()) {
        return;
    }
    if (readiness.phase() == Readiness::Phase::starting) {
        scenes_are_open();
    } else if (scenes_changed) {
        count_scenes();
        rooms->drop_outdated();
    }
}

void Server::Parts::count_scenes() {
    metrics.set_scenes(scenes.list().size(), scenes.total_bytes());
}

void Server::Parts::scenes_are_open() {
    const std::size_t count = scenes.list().size();
    count_scenes();
    if (count == 0) {
        spdlog::error("no_scene folder={:?}", configuration.scenes.string());
    }
    warm_up();
    try {
        check_decoder(configuration.decoder);
    } catch (const std::runtime_error& failure) {
        spdlog::error("uploads_fail reason={:?}", failure.what());
    }
    spdlog::info("ready scenes={} environments={} materials={}", count,
                 environments.list().size(), materials.list().size());
    readiness.set_ready();
}

// What every new room begins with is decoded before the first one asks.
void Server::Parts::warm_up() {
    const std::shared_ptr<Environment> first =
        environments.find(configuration.rooms.environment);
    try {
        for (const auto& scene : scenes.list()) {
            if (scene->loaded->is_lit()) {
                static_cast<void>(first->prefiltered(scene->loaded->face_resolution()));
            }
        }
    } catch (const std::exception& failure) {
        spdlog::error("environment_broken name={} reason={:?}", configuration.rooms.environment,
                      failure.what());
    }
}

void Server::Parts::wait_for(Clock::time_point deadline,
                             const std::function<bool()>& done) const {
    while (!done() && Clock::now() < deadline) {
        std::this_thread::sleep_for(kDrainPoll);
    }
}

Server::Server(const Configuration& configuration)
    : parts_(std::make_unique<Parts>(configuration)) {
    Parts& parts = *parts_;
    const auto endpoint = parts.listener.endpoint();
    spdlog::info("listening address={} port={}", endpoint.address().to_string(),
                 endpoint.port());
    if (!configuration.port_file.empty()) {
        const std::string text = fmt::format("{}\n", endpoint.port());
        files::write_file_atomically(configuration.port_file, {files::bytes_of(text)});
    }
    parts.listener.start(parts.services);
    for (std::size_t i = 0; i < configuration.io_threads; ++i) {
        parts.io_threads.emplace_back([&parts] { parts.io.run(); });
    }
    parts.watcher.emplace(configuration.scenes_interval,
                          [&parts](Patience patience, const std::stop_token& stop) {
                              parts.look(patience, stop);
                          });
}

Server::~Server() {
    drain();
}

std::uint16_t Server::port() const {
    return parts_->listener.endpoint().port();
}

void Server::wait_until_started() const {
    parts_->readiness.wait_until_started();
}

void Server::reload() {
    spdlog::info("reload");
    parts_->watcher->look_now();
}

bool Server::is_opening_scenes() const {
    return parts_->watcher->is_looking();
}

const Metrics& Server::metrics() const {
    return parts_->metrics;
}

void Server::drain() {
    Parts& parts = *parts_;
    if (std::exchange(parts.drained, true)) {
        return;
    }
    const Clock::time_point begin = Clock::now();
    const std::chrono::milliseconds bound(parts.configuration.drain_milliseconds);
    spdlog::info("draining connections={}", parts.listener.connections());
    parts.readiness.set_draining();
    parts.watcher->stop();
    parts.listener.stop();
    parts.rooms->stop_edits();
    parts.uploads.stop();
    parts.wait_for(begin + bound / 2, [&] { return !parts.rooms->has_pending_edit(); });
    parts.rooms->close_all(wire::CloseCode::shutting_down);
    parts.wait_for(begin + bound, [&] { return parts.listener.connections() == 0; });
    const std::size_t cut = parts.listener.connections();
    parts.io.stop();
    parts.io_threads.clear();
    parts.slow_requests.stop();
    parts.slow_requests.join();
    parts.workers.stop();
    parts.encoders.stop();
    spdlog::info("drained connections_cut={} milliseconds={:.0f}", cut,
                 milliseconds(Clock::now() - begin));
}

void check_configuration(const Configuration& configuration) {
    static_cast<void>(endpoint_from_address(configuration.listen));
    EnvironmentLibrary environments(configuration.environment_bounds);
    static_cast<void>(folder_of(environments, configuration));
    if (!environments.find(configuration.rooms.environment)) {
        throw std::runtime_error(
            fmt::format("--default-environment: there is no environment {}",
                        configuration.rooms.environment));
    }
    static_cast<void>(files_from(configuration.web_root));
    check_decoder(configuration.decoder);
    if (!configuration.materials.empty()) {
        MaterialLibrary(configuration.material_cache_bytes).refresh(configuration.materials);
    }
    SceneLibrary scenes;
    scenes.refresh(configuration.scenes);
    if (scenes.list().empty()) {
        throw std::runtime_error(
            fmt::format("no scene in {} can be served", configuration.scenes.string()));
    }
}

}  // namespace relume::net
