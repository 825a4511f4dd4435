// When a room's next slice of work is due, and which image it may bring.
//
// A *step* is one image's worth of relighting: what the budget of the state allows. It is cut
// into *slices*, each of which runs on a worker at once and ends by a ceiling of time. A step
// keeps the state that it began with; edits that come meanwhile wait for the next one.
#pragma once

#include "server/net/base/clock.h"
#include "server/net/rooms/room_pace.h"
#include "server/net/rooms/stages.h"
#include "server/net/rooms/worker_pool.h"

#include <optional>

namespace relume::net {

// What a slice is to do.
struct SliceOrder {
    Clock::time_point begun_at;
    bool takes_state = false;        // a step begins, with the state as it is
    wire::Stages stages;             // in which that differs from the state taken before
    bool first_image_due = false;    // of an edit, once its step is complete
    Clock::time_point edit_read_at;  // of the edit that its image answers
    Clock::time_point settle_at;     // when the state has rested for long enough
    // The mean of what an image spends outside its slices: waiting for a worker, being encoded.
    double overhead_ms = 0;
};

// What came of it.
struct SliceOutcome {
    bool at_rest = false;  // nothing is left to relight
    bool step_is_complete = true;
    // A picture of it is on its way, or has been sent.
    bool is_encoded = false;
    bool is_shown = false;
    // An edit's first image could be made, but the encoder was busy or nobody ready for it.
    bool picture_waits = false;
};

// Not thread-safe. Knows no threads and reads no clock: its room tells it what happens, and
// asks.
class Schedule {
  public:
    Schedule(Clock::duration settle_delay, Clock::time_point now);

    // A viewer's edit, read at `read_at`, has changed the state in these stages.
    void state_edited(wire::Stages stages, Clock::time_point read_at);
    // The server itself has changed the state in these stages.
    void state_changed(wire::Stages stages, Clock::time_point at);

    // Between these two no other slice of the room may run.
    [[nodiscard]] bool is_running() const { return is_running_; }
    [[nodiscard]] SliceOrder begin_slice(Clock::time_point now);
    void end_slice(const SliceOrder& order, const SliceOutcome& outcome, Clock::time_point now);
    // The slice has thrown. The next one takes the state as a whole.
    void slice_failed();

    // One picture at a time is being encoded.
    [[nodiscard]] bool is_encoding() const { return is_encoding_; }
    void encoding_ended();
    // The picture is lost, and its image is made again.
    void encoding_failed();
    // The time from a picture to its bytes, waiting for the encoder included.
    void encoding_took(Clock::duration time) { pace_.encoding_took(time); }

    struct Due {
        WorkPriority priority = WorkPriority::edit;
        Clock::time_point at;  // for an edit since when it waits, else when it is to begin
    };
    struct Conditions {
        bool settled_image_is_current = false;
        bool viewer_is_ready = false;  // for an image of an unsettled state
    };
    // The next slice. Nothing for a room that rests, nor while a slice runs: its end asks
    // again.
    [[nodiscard]] std::optional<Due> next_due(const Conditions& conditions,
                                              Clock::time_point now) const;
    // An edit's image waits for the encoder, or for a viewer who would take it.
    [[nodiscard]] bool picture_waits() const { return picture_waits_; }
    // An edit waits for its first image.
    [[nodiscard]] bool has_pending_edit() const;

  private:
    void begin_anew();

    const Clock::duration settle_delay_;
    bool is_running_ = false;
    bool is_encoding_ = false;
    bool is_at_rest_ = false;          // as the last slice left it
    bool step_is_unfinished_ = false;  // of an edit
    bool picture_waits_ = false;
    bool state_is_new_ = true;
    wire::Stages new_stages_ = kAllStages;
    // When the earliest edit was read that no step has taken, and that a step has taken but no
    // picture shows; and the edit that the latest picture answers.
    std::optional<Clock::time_point> untaken_edit_;
    std::optional<Clock::time_point> unshown_edit_;
    Clock::time_point answered_edit_;
    Clock::time_point last_change_;
    RoomPace pace_;
};

}  // namespace relume::net
