// A client in a room, over one WebSocket: edits out; snapshot, changes, errors and images in.
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

struct ConnectionOptions {
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

struct ConnectionEnd {
    bool was_open = false;  // a snapshot had come
    std::string reason;     // for people
};

// What a connection tells; all of it from within its executor, never concurrently.
struct ConnectionListener {
    // The first one.
    std::function<void(const wire::Snapshot&)> on_snapshot = [](const auto&) {};
    std::function<void(const wire::Change&)> on_change = [](const auto&) {};
    std::function<void(const wire::ErrorMessage&)> on_error = [](const auto&) {};
    std::function<void(ReceivedImage&&)> on_image = [](auto&&) {};
    std::function<void(const ConnectionEnd&)> on_end = [](const auto&) {};  // last of all, once
};

// Acknowledges every image once on_image has returned. Keeps itself alive while connected.
// Member functions are called from the listener's callbacks or from handlers on `executor()`.
class RoomConnection {
  public:
    RoomConnection(boost::asio::io_context& io,
                   ConnectionOptions options,
                   ConnectionListener listener);
    ~RoomConnection();
    RoomConnection(const RoomConnection&) = delete;
    RoomConnection& operator=(const RoomConnection&) = delete;
    RoomConnection(RoomConnection&&) = delete;
    RoomConnection& operator=(RoomConnection&&) = delete;

    void open();
    // Sends an edit and returns its id; ids count up from 1.
    std::uint64_t send_edit(nlohmann::json patch);
    // Says goodbye; on_end follows.
    void close();

    // A strand of the io_context; timers that touch the connection run on it.
    [[nodiscard]] boost::asio::any_io_executor executor() const;

  private:
    class Socket;
    std::shared_ptr<Socket> socket_;
};

// A name for a room that nobody else uses: "PREFIX-" and 16 random hexadecimal digits.
[[nodiscard]] std::string random_room_name(const std::string& prefix);

}  // namespace relume::cli
