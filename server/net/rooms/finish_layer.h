// Parts of a scene of kind `mesh` that are given other materials than they were baked with.
#pragma once

#include "server/net/rooms/room_layer.h"
#include "server/triple/finished_surface.h"

#include <optional>

namespace relume::net {

// What is not made of an image yet shows as it was before, vertex by vertex, as grains. An
// image therefore waits until it is whole, unless that takes longer than kLongestWaitMs of
// work.
class FinishLayer final : public RoomLayer {
  public:
    static constexpr double kLongestWaitMs = 250;

    // Of a scene with a lit surface.
    explicit FinishLayer(std::shared_ptr<const served::Scene> scene);

    [[nodiscard]] std::unique_ptr<view::View> make_view() override;
    // A layer that shows nothing is not told of the light. Reads the files of materials. A
    // material that cannot be read leaves the part as it was.
    [[nodiscard]] Change set_state(const wire::RoomState& state,
                                   const NamedFinishes& finishes,
                                   RoomSignal& signal,
                                   bool light_is_new,
                                   std::vector<wire::ErrorMessage>& problems) override;
    void set_view(const view::View& view) override;
    bool advance(double milliseconds) override { return surface_.advance(milliseconds); }
    [[nodiscard]] bool has_work() const override { return !surface_.exact(); }
    [[nodiscard]] bool awaits_first_look() const override {
        return has_work() && surface_.worked_milliseconds() < kLongestWaitMs;
    }
    [[nodiscard]] bool is_exact() const override { return surface_.exact(); }
    [[nodiscard]] bool shows_transport() const override { return shows_transport_; }
    // No more than the larger of both parts' errors.
    [[nodiscard]] double stated_error(double of_transport,
                                      double transport_norm) const override;
    [[nodiscard]] std::size_t remaining() const override { return surface_.stale_count(); }

  private:
    [[nodiscard]] triple::FinishedSurface::Finishes shown(
        const NamedFinishes& finishes, std::vector<wire::ErrorMessage>& problems) const;

    const std::shared_ptr<const served::Scene> scene_;
    triple::FinishedSurface surface_;
    wire::Finishes edits_;
    NamedFinishes families_;  // that the edits name
    bool light_is_new_ = true;
    bool shows_transport_ = true;
};

}  // namespace relume::net
