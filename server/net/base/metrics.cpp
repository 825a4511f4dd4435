#include "server/net/base/metrics.h"

#include "server/engine/session.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

namespace relume::net {

namespace {

using prometheus::BuildCounter;
using prometheus::BuildGauge;
using prometheus::BuildHistogram;
using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;
using prometheus::Registry;

Family<Counter>& counters(Registry& registry, const char* name, const char* help) {
    return BuildCounter().Name(name).Help(help).Register(registry);
}
Counter& counter(Registry& registry, const char* name, const char* help) {
    return counters(registry, name, help).Add({});
}
Gauge& gauge(Registry& registry, const char* name, const char* help) {
    return BuildGauge().Name(name).Help(help).Register(registry).Add({});
}
// From a tenth of a millisecond to five seconds, near enough equal steps in the logarithm.
Histogram& time_histogram(Registry& registry, const char* name, const char* help) {
    return BuildHistogram().Name(name).Help(help).Register(registry).Add(
        {}, Histogram::BucketBoundaries{1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 1.6e-2,
                                        2.5e-2, 5e-2, 0.1, 0.25, 0.5, 1, 2.5, 5});
}

}  // namespace

struct Metrics::Families {
    Registry registry;
    Family<Counter>& images = counters(registry, "relume_images_total", "Images encoded");
    Counter& jpeg_images = images.Add({{"encoding", "jpeg"}});
    Counter& half_images = images.Add({{"encoding", "half_planes"}});
    Family<Counter>& image_bytes =
        counters(registry, "relume_image_bytes_total", "Bytes of images encoded");
    Counter& jpeg_bytes = image_bytes.Add({{"encoding", "jpeg"}});
    Counter& half_bytes = image_bytes.Add({{"encoding", "half_planes"}});
    Counter& dropped_images =
        counter(registry,
                "relume_images_dropped_total",
                "Images replaced by a newer one before a client took them");
    Counter& sent_bytes =
        counter(registry, "relume_sent_bytes_total", "Bytes sent over WebSockets");
    Counter& edits = counter(registry, "relume_edits_total", "Edits accepted");
    Counter& steps =
        counter(registry, "relume_steps_total", "Relighting steps, or slices of them");
    Counter& coefficients = counter(
        registry, "relume_coefficients_applied_total", "Transport columns added to images");
    Counter& column_bytes =
        counter(registry, "relume_transport_bytes_touched_total", "Transport bytes read");
    Family<Counter>& errors =
        counters(registry, "relume_errors_total", "Requests and edits refused, by error code");
    Family<Counter>& closes = counters(
        registry, "relume_closes_total", "WebSockets closed by the server, by close code");
    Family<Counter>& requests =
        counters(registry, "relume_http_requests_total", "HTTP requests, by status");
    Counter& refused_connections =
        counter(registry,
                "relume_connections_refused_total",
                "Connections closed at once because there were too many");
    Histogram& lighting_seconds =
        time_histogram(registry,
                       "relume_lighting_seconds",
                       "Time from a changed state to its lighting and background");
    Histogram& relight_seconds = time_histogram(
        registry, "relume_relight_seconds", "Time of one relighting step, or slice of it");
    Histogram& compose_seconds = time_histogram(
        registry, "relume_compose_seconds", "Time to put relit image and background together");
    Histogram& encode_seconds =
        time_histogram(registry, "relume_encode_seconds", "Time to encode one image");
    Histogram& edit_to_image_seconds =
        time_histogram(registry,
                       "relume_edit_to_image_seconds",
                       "From reading an edit to the first finished image that holds it");
    Gauge& rooms = gauge(registry, "relume_rooms", "Rooms open");
    Gauge& clients = gauge(registry, "relume_clients", "Clients in all rooms");
    Gauge& connections = gauge(registry, "relume_connections", "TCP connections open");
    Gauge& scenes = gauge(registry, "relume_scenes", "Scenes served");
    Gauge& scene_bytes = gauge(registry, "relume_scene_bytes", "Bytes of transport in memory");
    Gauge& environment_bytes =
        gauge(registry, "relume_environment_bytes", "Bytes of environments kept in memory");
    Gauge& material_bytes =
        gauge(registry, "relume_material_bytes", "Bytes of materials in texels kept in memory");
    Gauge& dropped_log_lines = gauge(
        registry, "relume_log_lines_dropped", "Lines of the log that nobody took in time");
};

Metrics::Metrics() : families_(std::make_unique<Families>()) {}
Metrics::~Metrics() = default;

std::string Metrics::text() const {
    return prometheus::TextSerializer().Serialize(families_->registry.Collect());
}

void Metrics::observe_lighting(double seconds) {
    families_->lighting_seconds.Observe(seconds);
}

void Metrics::count_slice(const engine::StepReport& step, double relight_seconds) {
    families_->steps.Increment();
    families_->coefficients.Increment(step.applied);
    families_->column_bytes.Increment(static_cast<double>(step.bytes_touched));
    families_->relight_seconds.Observe(relight_seconds);
}

void Metrics::observe_compose(double seconds) {
    families_->compose_seconds.Observe(seconds);
}

void Metrics::count_image(wire::ImageEncoding encoding,
                          std::size_t bytes,
                          double encode_seconds) {
    const bool jpeg = encoding == wire::ImageEncoding::jpeg;
    (jpeg ? families_->jpeg_images : families_->half_images).Increment();
    (jpeg ? families_->jpeg_bytes : families_->half_bytes)
        .Increment(static_cast<double>(bytes));
    families_->encode_seconds.Observe(encode_seconds);
}

void Metrics::observe_edit_to_image(double seconds) {
    families_->edit_to_image_seconds.Observe(seconds);
}
void Metrics::count_dropped_image() {
    families_->dropped_images.Increment();
}
void Metrics::count_sent(std::size_t bytes) {
    families_->sent_bytes.Increment(static_cast<double>(bytes));
}
void Metrics::count_edit() {
    families_->edits.Increment();
}
void Metrics::count_error(wire::ErrorCode code) {
    families_->errors.Add({{"code", std::string(wire::name_from_error_code(code))}})
        .Increment();
}
void Metrics::count_close(wire::CloseCode code) {
    families_->closes.Add({{"code", std::to_string(static_cast<unsigned>(code))}}).Increment();
}
void Metrics::count_request(unsigned status) {
    families_->requests.Add({{"status", std::to_string(status)}}).Increment();
}
void Metrics::count_refused_connection() {
    families_->refused_connections.Increment();
}
void Metrics::set_rooms(std::size_t count) {
    families_->rooms.Set(static_cast<double>(count));
}
void Metrics::add_clients(int difference) {
    families_->clients.Increment(difference);
}
void Metrics::add_connections(int difference) {
    families_->connections.Increment(difference);
}
void Metrics::set_scenes(std::size_t count, std::uint64_t bytes) {
    families_->scenes.Set(static_cast<double>(count));
    families_->scene_bytes.Set(static_cast<double>(bytes));
}
void Metrics::set_environment_bytes(std::size_t bytes) {
    families_->environment_bytes.Set(static_cast<double>(bytes));
}
void Metrics::set_material_bytes(std::size_t bytes) {
    families_->material_bytes.Set(static_cast<double>(bytes));
}
void Metrics::set_dropped_log_lines(std::uint64_t count) {
    families_->dropped_log_lines.Set(static_cast<double>(count));
}

std::uint64_t Metrics::slices() const {
    return static_cast<std::uint64_t>(families_->steps.Value());
}
std::uint64_t Metrics::images(wire::ImageEncoding encoding) const {
    const Counter& images =
        encoding == wire::ImageEncoding::jpeg ? families_->jpeg_images : families_->half_images;
    return static_cast<std::uint64_t>(images.Value());
}

}  // namespace relume::net
