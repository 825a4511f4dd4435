#include "client/cli/load_test.h"

#include "client/cli/curve_drag.h"
#include "client/cli/finish_drag.h"
#include "client/cli/room_connection.h"
#include "client/cli/statistics.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace relume::cli {
namespace {

namespace asio = boost::asio;

constexpr double kDegreesPerEdit = 1.5;
// After the last edit, for its image to come.
constexpr std::chrono::seconds kGrace{2};

// For a connection to open and show its first image, beside all the others.
constexpr std::chrono::seconds kLongestOpening{120};

Clock::duration from_seconds(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

// Where visitors wait for each other, so that what is measured is dragging and not opening.
// Safe to share between threads.
class StartingLine {
  public:
    StartingLine(std::size_t count, std::function<void()> on_all)
        : missing_(count), on_all_(std::move(on_all)) {}

    void arrive() {
        if (--missing_ == 0) {
            on_all_();
        }
    }

  private:
    std::atomic<std::size_t> missing_;
    const std::function<void()> on_all_;
};

// What all visitors did so far. Safe to share between threads.
struct Tally {
    std::atomic<std::size_t> shown = 0;  // connections that have their first image, or ended
    std::atomic<std::size_t> ended = 0;  // connections
    std::atomic<std::size_t> edits = 0;
    std::atomic<std::size_t> images = 0;
};

// Tells how far all visitors are until all have left.
class Teller {
  public:
    Teller(asio::io_context& io, const LoadOptions& options, const Tally& tally)
        : options_(options), tally_(tally), beat_(asio::make_strand(io)) {}

    void tell() {
        const std::size_t connections = options_.dragging + options_.idle;
        options_.on_progress({.connections = connections,
                              .shown = tally_.shown,
                              .edits = tally_.edits,
                              .images = tally_.images});
        if (tally_.ended == connections) {
            return;
        }
        beat_.expires_after(std::chrono::milliseconds(250));
        beat_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                tell();
            }
        });
    }

  private:
    const LoadOptions& options_;
    const Tally& tally_;
    asio::steady_timer beat_;
};

// One simulated person. Everything in it happens on the connection's strand.
class Visitor {
  public:
    Visitor(asio::io_context& io,
            const LoadOptions& options,
            ConnectionOptions connection,
            bool drags,
            std::uint64_t seed,
            StartingLine& line,
            Tally& tally)
        : options_(options),
          drags_(drags),
          seed_(seed),
          line_(line),
          tally_(tally),
          connection_(io, std::move(connection), listener()),
          beat_(connection_.executor()),
          end_(connection_.executor()) {}

    void open() {
        opened_at_ = Clock::now();
        end_by(opened_at_ + kLongestOpening);
        connection_.open();
    }

    // Everybody is there; the first edit comes after a delay.
    void go(Clock::duration delay) {
        asio::post(connection_.executor(), [this, delay] {
            if (has_ended_) {
                return;
            }
            next_edit_at_ = Clock::now() + delay;
            last_edit_by_ = next_edit_at_ + from_seconds(options_.seconds);
            end_by(last_edit_by_ + kGrace);
            if (drags_) {
                drag();
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
    std::vector<double> stated_errors;     // of images that answered an edit
    std::optional<double> first_image_ms;  // since it began to open
    std::map<std::string, std::size_t> errors;
    std::string early_end;  // empty when it lasted

  private:
    ConnectionListener listener() {
        return {.on_snapshot = [this](const wire::Snapshot& s) { joined(s.scene); },
                .on_change = [](const wire::Change&) {},
                .on_error =
                    [this](const wire::ErrorMessage& e) {
                        ++errors[std::string(wire::name_from_error_code(e.code))];
                    },
                .on_image = [this](ReceivedImage&& i) { image(i); },
                .on_end = [this](const ConnectionEnd& e) { ended(e); }};
    }

    void end_by(Clock::time_point time) {
        end_.expires_at(time);
        end_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                lasted_ = last_edit_by_ != Clock::time_point{};
                beat_.cancel();
                connection_.close();
            }
        });
    }

    void joined(const wire::SceneSummary& scene) {
        opened = true;
        if (drags_ && !scene.materials.empty()) {
            curve_drag_.emplace(scene.materials, seed_);
        }
        if (auto materials = materials_for(scene, options_.materials);
            drags_ && !materials.empty()) {
            finish_drag_.emplace(scene, std::move(materials), seed_);
        }
        if (!drags_) {
            arrive();
        }
    }

    void arrive() {
        if (!has_arrived_) {
            has_arrived_ = true;
            ++tally_.shown;
            line_.arrive();
        }
    }

    void drag() {
        beat_.expires_at(next_edit_at_);
        beat_.async_wait([this](const boost::system::error_code& error) {
            if (error || next_edit_at_ >= last_edit_by_) {
                return;
            }
            nlohmann::json patch = edits == 0 ? options_.patch : nlohmann::json::object();
            patch.update(next_edit());  // a section that is dragged is not the patch's
            if (edits == 0 && options_.budget_ms) {
                patch["budget"]["milliseconds"] = *options_.budget_ms;
            }
            connection_.send_edit(patch);
            ++edits;
            ++tally_.edits;
            next_edit_at_ += from_seconds(1 / options_.rate_hz);
            drag();
        });
    }

    // Where curves of materials are edited a hand draws over them, where parts are given
    // materials it moves all there is, else it turns the light.
    nlohmann::json next_edit() {
        if (finish_drag_) {
            return finish_drag_->next();
        }
        if (curve_drag_) {
            return curve_drag_->next();
        }
        yaw_degrees_ += kDegreesPerEdit;
        return {{"rotation", {{"yaw_degrees", yaw_degrees_}}}};
    }

    void image(const ReceivedImage& received) {
        ++images;
        ++tally_.images;
        if (!first_image_ms) {
            first_image_ms =
                std::chrono::duration<double, std::milli>(received.received - opened_at_)
                    .count();
        }
        arrive();
        images_while_dragging += received.received < last_edit_by_ ? 1U : 0U;
        exact_images += received.header.exact ? 1U : 0U;
        bytes += received.payload.size();
        edit_to_image_ms.insert(edit_to_image_ms.end(), received.edit_to_image_ms.begin(),
                                received.edit_to_image_ms.end());
        if (!received.edit_to_image_ms.empty()) {
            stated_errors.push_back(received.header.relative_error);
        }
    }

    void ended(const ConnectionEnd& e) {
        has_ended_ = true;
        ++tally_.ended;
        beat_.cancel();
        end_.cancel();
        arrive();
        if (!lasted_) {
            early_end = e.reason;
        }
    }

    const LoadOptions& options_;
    bool drags_;
    std::uint64_t seed_;
    StartingLine& line_;
    Tally& tally_;
    Clock::time_point opened_at_;
    bool has_arrived_ = false;
    bool has_ended_ = false;
    bool lasted_ = false;
    double yaw_degrees_ = 0;
    std::optional<CurveDrag> curve_drag_;
    std::optional<FinishDrag> finish_drag_;
    Clock::time_point next_edit_at_;
    Clock::time_point last_edit_by_;  // set once everybody is there
    RoomConnection connection_;
    asio::steady_timer beat_;
    asio::steady_timer end_;
};

ConnectionOptions connection_options(const LoadOptions& options, bool drags) {
    return {.server = options.server,
            .room = random_room_name("load"),
            .scene = options.scene,
            .images = drags ? ImageChoice::all : ImageChoice::settled,
            .token = options.token};
}

}  // namespace

nlohmann::json run_load_test(const LoadOptions& options) {
    asio::io_context io(static_cast<int>(options.threads));
    Tally tally;
    Teller teller(io, options, tally);
    std::vector<std::unique_ptr<Visitor>> visitors;
    const std::size_t count = options.dragging + options.idle;
    StartingLine line(count, [&] {
        for (std::size_t i = 0; i < count; ++i) {
            // Spread over one beat, or all edits of all connections would come at once.
            visitors[i]->go(from_seconds(static_cast<double>(i) /
                                         (options.rate_hz * static_cast<double>(count))));
        }
    });
    for (std::size_t i = 0; i < count; ++i) {
        const bool drags = i < options.dragging;
        visitors.push_back(std::make_unique<Visitor>(
            io, options, connection_options(options, drags), drags, i, line, tally));
    }
    for (const auto& visitor : visitors) {
        visitor->open();
    }
    if (options.on_progress) {
        teller.tell();
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
    std::vector<double> stated_errors;
    std::vector<double> first_image_ms;
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
        stated_errors.insert(stated_errors.end(), visitor->stated_errors.begin(),
                             visitor->stated_errors.end());
        if (visitor->first_image_ms) {
            first_image_ms.push_back(*visitor->first_image_ms);
        }
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
    put_spread(result, "first_image_ms", spread_of(std::move(first_image_ms)));
    put_spread(result, "edit_to_image_ms", spread_of(std::move(edit_to_image_ms)));
    put_spread(result, "stated_error", spread_of(std::move(stated_errors)));
    return result;
}

}  // namespace relume::cli
