// What the server tells Prometheus.
#pragma once

#include "protocol/wire/errors.h"
#include "protocol/wire/image_header.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace relume::engine {
struct StepReport;
}

namespace relume::net {

// Thread-safe. Each server has its own, so that two in one process do not mix.
class Metrics {
  public:
    Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;
    ~Metrics();

    // The text exposition format, version 0.0.4.
    [[nodiscard]] std::string text() const;

    // The time from a changed state to lighting coefficients and background.
    void observe_lighting(double seconds);
    void count_slice(const engine::StepReport& step, double relight_seconds);
    void observe_compose(double seconds);
    void count_image(wire::ImageEncoding encoding, std::size_t bytes, double encode_seconds);
    void observe_edit_to_image(double seconds);
    void count_dropped_image();
    void count_sent(std::size_t bytes);
    void count_edit();
    void count_error(wire::ErrorCode code);
    void count_close(wire::CloseCode code);
    void count_request(unsigned status);
    void count_refused_connection();
    void set_rooms(std::size_t count);
    void add_clients(int difference);
    void add_connections(int difference);
    void set_scenes(std::size_t count, std::uint64_t bytes);
    void set_environment_bytes(std::size_t bytes);
    void set_material_bytes(std::size_t bytes);
    void set_dropped_log_lines(std::uint64_t count);

    // Slices relit for all rooms so far: stands still when every room is at rest.
    [[nodiscard]] std::uint64_t slices() const;
    [[nodiscard]] std::uint64_t images(wire::ImageEncoding encoding) const;

  private:
    struct Families;
    std::unique_ptr<Families> families_;
};

}  // namespace relume::net
