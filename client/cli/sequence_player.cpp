#include "client/cli/sequence_player.h"

#include "client/cli/client_error.h"
#include "client/cli/image_writer.h"
#include "protocol/wire/room_patch.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

namespace relume::cli {
namespace {

namespace asio = boost::asio;

// How long one edit may take to show; a first environment has to be decoded for it.
constexpr std::chrono::seconds kShowTimeout{120};

Clock::duration from_seconds(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

class Player {
  public:
    explicit Player(const SequenceOptions& options)
        : options_(options),
          connection_(io_, options.connection, listener()),
          timer_(connection_.executor()),
          deadline_(connection_.executor()) {}

    SequenceReport run() {
        report_.room = options_.connection.room;
        report_.rate_hz = options_.rate_hz;
        set_deadline(kShowTimeout, "a snapshot");
        connection_.open();
        io_.run();
        if (!failure_.empty()) {
            throw ClientError(failure_);
        }
        writer_.finish();
        return std::move(report_);
    }

  private:
    ConnectionListener listener() {
        return {
            .on_snapshot = [this](const wire::Snapshot& s) { snapshot(s); },
            .on_change = [this](const wire::Change& c) { change(c); },
            .on_error = [this](const wire::ErrorMessage& e) { fail("refused: " + e.message); },
            .on_image = [this](ReceivedImage&& i) { image(std::move(i)); },
            .on_end = [this](const ConnectionEnd& e) { ended(e); }};
    }

    void snapshot(const wire::Snapshot& s) {
        report_.scene = s.scene.name;
        state_ = s.state;
        limits_ = s.limits;
        if (!options_.script.start.empty()) {
            edit(options_.script.start);
        }
        // Nothing is measured before the first image of the start is there.
        await([this] { return last_edit_shown_ && any_image_; }, kShowTimeout,
              "an image of the start", [this] { begin(); });
    }

    void begin() {
        begun_ = Clock::now();
        report_.edits = 0;
        next_step();
    }

    void next_step() {
        if (step_ == options_.script.steps.size()) {
            await([this] { return last_edit_shown_; }, kShowTimeout,
                  "an image of the last edit", [this] { finish(); });
            return;
        }
        const Step& step = options_.script.steps[step_];
        if (const auto* rest = std::get_if<Rest>(&step)) {
            take_rest(*rest);
        } else {
            next_tick_ = std::max(next_tick_, Clock::now());
            tick(0);
        }
    }

    void take_rest(const Rest& rest) {
        if (rest.seconds) {
            after(Clock::now() + from_seconds(*rest.seconds), [this] { step_done(); });
        } else {
            await([this] { return last_edit_shown_ && exact_; },
                  from_seconds(rest.timeout_seconds), "an exact image",
                  [this] { step_done(); });
        }
    }

    void step_done() {
        ++step_;
        next_step();
    }

    // Ticks keep to the beat: a late one does not delay those after it.
    void tick(std::uint32_t index) {
        after(next_tick_, [this, index] {
            const Step& step = options_.script.steps[step_];
            edit(patch_of(step, index));
            next_tick_ += from_seconds(1 / options_.rate_hz);
            if (index + 1 < edit_count(step)) {
                tick(index + 1);
            } else {
                step_done();
            }
        });
    }

    void edit(nlohmann::json patch) {
        last_edit_id_ = connection_.send_edit(std::move(patch));
        last_edit_revision_.reset();
        last_edit_shown_ = false;
        exact_ = false;
        ++report_.edits;
    }

    void change(const wire::Change& c) {
        wire::apply_patch(state_, c.patch, limits_);
        if (c.edit_id && *c.edit_id >= last_edit_id_) {
            last_edit_revision_ = c.revision;
        }
    }

    void image(ReceivedImage&& received) {
        const wire::ImageHeader& header = received.header;
        any_image_ = true;
        if (last_edit_revision_ && header.revision >= *last_edit_revision_) {
            last_edit_shown_ = true;
        }
        exact_ = header.exact && last_edit_shown_;
        if (begun_) {
            const double relative_error = header.relative_error;
            record(std::move(received));
            if (options_.on_progress) {
                options_.on_progress({.step = step_,
                                      .steps = options_.script.steps.size(),
                                      .edits = report_.edits,
                                      .images = report_.images.size(),
                                      .relative_error = relative_error});
            }
        }
        if (condition_ && condition_()) {
            condition_ = nullptr;
            deadline_.cancel();
            // Not from within: this image has yet to be acknowledged.
            asio::post(connection_.executor(), std::exchange(reached_, nullptr));
        }
    }

    void record(ReceivedImage&& received) {
        ImageRecord record{
            .time_s = std::chrono::duration<double>(received.received - *begun_).count(),
            .step = std::min(step_, options_.script.steps.size() - 1),
            .header = received.header,
            .edit_to_image_ms = std::move(received.edit_to_image_ms),
            .file = {}};
        if (options_.files != ImageFiles::none) {
            record.file = fmt::format("image_{:05}{}", report_.images.size(),
                                      extension_for(received.header.encoding));
            writer_.add({.path = options_.folder / record.file,
                         .header = received.header,
                         .payload = std::move(received.payload),
                         .display = state_.display});
        }
        report_.images.push_back(std::move(record));
    }

    [[nodiscard]] const char* extension_for(wire::ImageEncoding encoding) const {
        if (options_.files == ImageFiles::png) {
            return ".png";
        }
        return options_.files == ImageFiles::exr && encoding == wire::ImageEncoding::half_planes
                   ? ".exr"
                   : ".jpg";
    }

    // Calls `then` when `condition` holds, at once or after an image.
    void await(std::function<bool()> condition,
               Clock::duration timeout,
               std::string what,
               std::function<void()> then) {
        if (condition()) {
            then();
            return;
        }
        condition_ = std::move(condition);
        reached_ = std::move(then);
        set_deadline(timeout, std::move(what));
    }

    void set_deadline(Clock::duration timeout, std::string what) {
        deadline_.expires_after(timeout);
        deadline_.async_wait(
            [this, timeout, what = std::move(what)](const boost::system::error_code& error) {
                if (!error) {
                    fail(fmt::format("after {} s: found no answer, expected {}",
                                     std::chrono::duration<double>(timeout).count(), what));
                }
            });
    }

    void after(Clock::time_point when, std::function<void()> action) {
        timer_.expires_at(when);
        timer_.async_wait([action = std::move(action)](const boost::system::error_code& error) {
            if (!error) {
                action();
            }
        });
    }

    void finish() {
        report_.seconds = std::chrono::duration<double>(Clock::now() - *begun_).count();
        done_ = true;
        stop();
    }

    void fail(const std::string& why) {
        if (failure_.empty() && !done_) {
            failure_ = fmt::format("step {}: {}", step_, why);
            stop();
        }
    }

    void stop() {
        condition_ = nullptr;
        timer_.cancel();
        deadline_.cancel();
        connection_.close();
    }

    void ended(const ConnectionEnd& e) {
        fail("the connection ended: " + e.reason);
        timer_.cancel();
        deadline_.cancel();
    }

    const SequenceOptions& options_;
    asio::io_context io_{1};
    RoomConnection connection_;
    asio::steady_timer timer_;     // the beat and timed rests
    asio::steady_timer deadline_;  // of what is awaited
    ImageWriter writer_;
    SequenceReport report_;
    wire::RoomState state_;
    wire::Limits limits_;
    std::optional<Clock::time_point> begun_;
    Clock::time_point next_tick_;
    std::size_t step_ = 0;
    std::uint64_t last_edit_id_ = 0;
    std::optional<std::uint64_t> last_edit_revision_;
    bool last_edit_shown_ = true;  // no edit yet
    bool any_image_ = false;
    bool exact_ = false;
    bool done_ = false;
    std::function<bool()> condition_;
    std::function<void()> reached_;
    std::string failure_;
};

}  // namespace

SequenceReport play_sequence(const SequenceOptions& options) {
    return Player(options).run();
}

}  // namespace relume::cli
