// A whole server in this process: scenes, environments, rooms, sockets, threads.
#pragma once

#include "server/net/configuration.h"

#include <cstdint>
#include <memory>

namespace relume::net {

class Metrics;

// A server listens and opens scenes from its construction on, and ends when it is destroyed.
// Its functions may be called from any thread.
class Server {
  public:
    // Throws ListenError, or std::runtime_error for folders that cannot be read.
    explicit Server(const Configuration& configuration);
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    // Drains, if that has not been done.
    ~Server();

    [[nodiscard]] std::uint16_t port() const;
    // Waits until all scenes have been opened.
    void wait_until_started() const;
    [[nodiscard]] const Metrics& metrics() const;

    // Looks at the folders of scenes and environments again, now.
    void reload();
    // A scene is being opened: whoever destroys the server waits until it is.
    [[nodiscard]] bool is_opening_scenes() const;

    // Takes no more connections and edits, sends the images that edits wait for, closes all
    // connections (1001), and ends all threads but one that is opening a scene, in at most the
    // time configured.
    void drain();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// What --check-config says: throws as the constructor of Server does for what can be known
// without listening.
void check_configuration(const Configuration& configuration);

}  // namespace relume::net
