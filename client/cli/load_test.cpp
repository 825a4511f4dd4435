#include "client/cli/load_test.h"

#include "client/cli/session.h"
#include "client/cli/statistics.h"

#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <thread>
#include <vector>

namespace relume::cli {
namespace {

namespace asio = boost::asio;

constexpr double kDegreesPerEdit = 1.5;
// After the last edit, for its image to come.
constexpr std::chrono::seconds kGrace{2};

// One simulated person. Everything in it happens on the session's strand.
class Visitor {
  public:
    Visitor(asio::io_context& io,
            const LoadOptions& options,
            SessionOptions session,
            bool drags)
        : options_(options),
          drags_(drags),
          session_(io, std::move(session), listener()),
          beat_(session_.executor()),
          end_(session_.executor()) {}

    void start(Clock::duration delay) {
        end_.expires_after(delay);
        end_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                arm_end();
                session_.open();
            }
        });
    }

    std::size_t edits = 0;
    std::size_t images = 0;
    std::size_t images_while_dragging = 0;
    std::size_t exact_images = 0;
    std::uint64_t bytes = 0;
    bool opened = false;
    std::vector<double> edit_to_image_ms;
    std::map<std::string, std::size_t> errors;
    std::string early_end;  // empty when it lasted

  private:
    SessionListener listener() {
        return {.on_snapshot = [this](const wire::Snapshot&) { begin(); },
                .on_change = [](const wire::Change&) {},
                .on_error =
                    [this](const wire::ErrorMessage& e) {
                        ++errors[std::string(wire::name_from_error_code(e.code))];
                    },
                .on_image = [this](ReceivedImage&& i) { image(i); },
                .on_end = [this](const SessionEnd& e) { ended(e); }};
    }

    void arm_end() {
        const auto seconds = std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(options_.seconds));
        last_edit_by_ = Clock::now() + seconds;
        end_.expires_at(last_edit_by_ + kGrace);
        end_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                lasted_ = true;
                beat_.cancel();
                session_.close();
            }
        });
    }

    void begin() {
        opened = true;
        next_edit_ = Clock::now();
        if (drags_) {
            drag();
        }
    }

    void drag() {
        beat_.expires_at(next_edit_);
        beat_.async_wait([this](const boost::system::error_code& error) {
            if (error || next_edit_ >= last_edit_by_) {
                return;
            }
            yaw_degrees_ += kDegreesPerEdit;
            session_.send_edit({{"rotation", {{"yaw_degrees", yaw_degrees_}}}});
            ++edits;
            next_edit_ += std::chrono::duration_cast<Clock::duration>(
                std::chrono::duration<double>(1 / options_.rate_hz));
            drag();
        });
    }

    void image(const ReceivedImage& received) {
        ++images;
        images_while_dragging += received.received < last_edit_by_ ? 1U : 0U;
        exact_images += received.header.exact ? 1U : 0U;
        bytes += received.payload.size();
        edit_to_image_ms.insert(edit_to_image_ms.end(), received.edit_to_image_ms.begin(),
                                received.edit_to_image_ms.end());
    }

    void ended(const SessionEnd& e) {
        beat_.cancel();
        end_.cancel();
        if (!lasted_) {
            early_end = e.reason;
        }
    }

    const LoadOptions& options_;
    bool drags_;
    bool lasted_ = false;
    double yaw_degrees_ = 0;
    Clock::time_point next_edit_;
    Clock::time_point last_edit_by_;
    Session session_;
    asio::steady_timer beat_;
    asio::steady_timer end_;
};

SessionOptions session_options(const LoadOptions& options, bool drags) {
    return {.server = options.server,
            .room = random_room_name("load"),
            .scene = options.scene,
            .images = drags ? ImageChoice::all : ImageChoice::settled,
            .token = options.token};
}

}  // namespace

nlohmann::json run_load_test(const LoadOptions& options) {
    asio::io_context io(static_cast<int>(options.threads));
    std::vector<std::unique_ptr<Visitor>> visitors;
    const std::size_t count = options.dragging + options.idle;
    for (std::size_t i = 0; i < count; ++i) {
        const bool drags = i < options.dragging;
        visitors.push_back(
            std::make_unique<Visitor>(io, options, session_options(options, drags), drags));
        // Spread over one beat, or all edits of all sessions would come at once.
        const double delay =
            static_cast<double>(i) / (options.rate_hz * static_cast<double>(count));
        visitors.back()->start(
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(delay)));
    }
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < options.threads; ++i) {
            threads.emplace_back([&io] { io.run(); });
        }
        io.run();
    }

    std::size_t opened = 0;
    std::size_t edits = 0;
    std::size_t images = 0;
    std::size_t images_while_dragging = 0;
    std::size_t exact_images = 0;
    std::uint64_t bytes = 0;
    std::vector<double> edit_to_image_ms;
    std::map<std::string, std::size_t> errors;
    std::map<std::string, std::size_t> ends;
    for (const auto& visitor : visitors) {
        opened += visitor->opened ? 1U : 0U;
        edits += visitor->edits;
        images += visitor->images;
        images_while_dragging += visitor->images_while_dragging;
        exact_images += visitor->exact_images;
        bytes += visitor->bytes;
        edit_to_image_ms.insert(edit_to_image_ms.end(), visitor->edit_to_image_ms.begin(),
                                visitor->edit_to_image_ms.end());
        for (const auto& [code, times] : visitor->errors) {
            errors[code] += times;
        }
        if (!visitor->early_end.empty()) {
            ++ends[visitor->early_end];
        }
    }
    nlohmann::json result = {
        {"sessions", count},
        {"opened", opened},
        {"dragging", options.dragging},
        {"idle", options.idle},
        {"rate_hz", options.rate_hz},
        {"seconds", options.seconds},
        {"edits", edits},
        {"edits_shown", edit_to_image_ms.size()},
        {"images", images},
        {"exact_images", exact_images},
        {"images_per_second", static_cast<double>(images_while_dragging) / options.seconds},
        {"bytes", bytes},
        {"errors", errors},
        {"ends", ends},
        {"ok", opened == count && errors.empty() && ends.empty()}};
    put_spread(result, "edit_to_image_ms", spread_of(std::move(edit_to_image_ms)));
    return result;
}

}  // namespace relume::cli
