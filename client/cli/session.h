// One WebSocket session with a server: edits out; snapshot, changes, errors and images in.
#pragma once

#include "client/cli/edit_clock.h"
#include "client/cli/url.h"
#include "protocol/wire/image_header.h"
#include "protocol/wire/messages.h"

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace relume::cli {

enum class ImageChoice { all, settled };

struct SessionOptions {
    Url server;
    std::string room;
    std::string scene;  // may be empty when the room exists
    ImageChoice images = ImageChoice::all;
    std::string token;
    std::chrono::seconds connect_timeout{10};
};

struct ReceivedImage {
    wire::ImageHeader header;
    std::vector<std::byte> payload;
    Clock::time_point received;
    // Of each edit this image is the first to show, oldest first; empty for none.
    std::vector<double> edit_to_image_ms;
};

struct SessionEnd {
    bool was_open = false;  // a snapshot had come
    std::string reason;     // for people
};

// What a session tells; all of it from within Session::run's executor, never concurrently.
struct SessionListener {
    // The first one.
    std::function<void(const wire::Snapshot&)> on_snapshot = [](const auto&) {};
    std::function<void(const wire::Change&)> on_change = [](const auto&) {};
    std::function<void(const wire::ErrorMessage&)> on_error = [](const auto&) {};
    std::function<void(ReceivedImage&&)> on_image = [](auto&&) {};
    std::function<void(const SessionEnd&)> on_end = [](const auto&) {};  // last of all, once
};

// Acknowledges every image once on_image has returned. Keeps itself alive while connected.
// Member functions are called from the listener's callbacks or from handlers on `executor()`.
class Session {
  public:
    Session(boost::asio::io_context& io, SessionOptions options, SessionListener listener);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;

    void open();
    // Sends an edit and returns its id; ids count up from 1.
    std::uint64_t send_edit(nlohmann::json patch);
    // Says goodbye; on_end follows.
    void close();

    // A strand of the io_context; timers that touch the session run on it.
    [[nodiscard]] boost::asio::any_io_executor executor() const;

  private:
    class Connection;
    std::shared_ptr<Connection> connection_;
};

// A name for a room that nobody else uses: "PREFIX-" and 16 random hexadecimal digits.
[[nodiscard]] std::string random_room_name(const std::string& prefix);

}  // namespace relume::cli
