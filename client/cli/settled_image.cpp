#include "client/cli/settled_image.h"

#include "client/cli/client_error.h"
#include "protocol/wire/room_patch.h"

#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

namespace relume::cli {
namespace {

namespace asio = boost::asio;

class Fetch {
  public:
    explicit Fetch(const SettledImageRequest& request)
        : request_(request),
          connection_(io_, options_of(request), listener()),
          deadline_(connection_.executor()) {}

    SettledImage run() {
        deadline_.expires_after(request_.timeout);
        deadline_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                fail(fmt::format("after {} ms: found {}, expected {}", request_.timeout.count(),
                                 progress_, goal()));
            }
        });
        connection_.open();
        io_.run();
        if (!failure_.empty()) {
            throw ClientError(failure_);
        }
        return std::move(result_);
    }

  private:
    static ConnectionOptions options_of(const SettledImageRequest& request) {
        ConnectionOptions options = request.connection;
        options.images = ImageChoice::settled;
        return options;
    }

    ConnectionListener listener() {
        return {.on_snapshot = [this](const wire::Snapshot& s) { snapshot(s); },
                .on_change = [this](const wire::Change& c) { change(c); },
                .on_error = [this](const wire::ErrorMessage& e) { refused(e); },
                .on_image = [this](ReceivedImage&& i) { image(i); },
                .on_end = [this](const ConnectionEnd& e) { ended(e); }};
    }

    [[nodiscard]] std::string goal() const {
        return request_.until_error
                   ? fmt::format("an image of stated error at most {}", *request_.until_error)
                   : "an exact image";
    }

    void snapshot(const wire::Snapshot& s) {
        result_.scene = s.scene;
        result_.state = s.state;
        limits_ = s.limits;
        if (request_.patch.empty()) {
            needed_revision_ = s.revision;
            progress_ = "no settled image yet";
        } else {
            sent_ = Clock::now();
            edit_id_ = connection_.send_edit(request_.patch);
            progress_ = "no answer to the edit";
        }
    }

    void change(const wire::Change& c) {
        wire::apply_patch(result_.state, c.patch, limits_);
        if (edit_id_ && c.edit_id && *c.edit_id >= *edit_id_ && !needed_revision_) {
            needed_revision_ = c.revision;
            progress_ = fmt::format("no settled image of revision {} yet", c.revision);
        }
    }

    void refused(const wire::ErrorMessage& e) {
        fail(fmt::format("the server refused the edit: {}", e.message));
    }

    void image(const ReceivedImage& received) {
        const wire::ImageHeader& header = received.header;
        if (header.encoding != wire::ImageEncoding::half_planes || !needed_revision_ ||
            header.revision < *needed_revision_) {
            return;
        }
        // The header states single precision, the state double.
        constexpr double kRounding = 1e-6;
        const bool good_enough =
            header.exact || (request_.until_error &&
                             header.relative_error <= *request_.until_error * (1 + kRounding));
        if (!good_enough) {
            progress_ = fmt::format("an image of stated error {}", header.relative_error);
            return;
        }
        result_.header = header;
        result_.image = wire::decode_half_image(received.payload, header.width, header.height,
                                                header.has_alpha);
        if (sent_) {
            result_.edit_to_image_ms =
                std::chrono::duration<double, std::milli>(received.received - *sent_).count();
        }
        done_ = true;
        finish();
    }

    void ended(const ConnectionEnd& e) {
        deadline_.cancel();
        if (!done_ && failure_.empty()) {
            failure_ = e.was_open ? "the server ended the connection: " + e.reason : e.reason;
        }
    }

    void fail(std::string why) {
        if (!done_ && failure_.empty()) {
            failure_ = std::move(why);
            finish();
        }
    }

    void finish() {
        deadline_.cancel();
        connection_.close();
    }

    const SettledImageRequest& request_;
    asio::io_context io_{1};
    RoomConnection connection_;
    asio::steady_timer deadline_;
    wire::Limits limits_;
    SettledImage result_;
    std::optional<std::uint64_t> edit_id_;
    std::optional<std::uint64_t> needed_revision_;
    std::optional<Clock::time_point> sent_;
    std::string progress_ = "no snapshot yet";
    std::string failure_;
    bool done_ = false;
};

}  // namespace

SettledImage fetch_settled_image(const SettledImageRequest& request) {
    return Fetch(request).run();
}

}  // namespace relume::cli
