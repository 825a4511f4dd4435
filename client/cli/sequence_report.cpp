#include "client/cli/sequence_report.h"

#include "client/cli/statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relume::cli {
namespace {

using nlohmann::json;

const char* name_of(wire::ImageEncoding encoding) {
    return encoding == wire::ImageEncoding::jpeg ? "jpeg" : "half_planes";
}

json json_from_record(const ImageRecord& image) {
    const wire::ImageHeader& h = image.header;
    json record = {{"time_s", image.time_s},
                   {"step", image.step},
                   {"sequence", h.sequence},
                   {"revision", h.revision},
                   {"encoding", name_of(h.encoding)},
                   {"relative_error", h.relative_error},
                   {"exact", h.exact},
                   {"edit_to_image_ms", image.edit_to_image_ms},
                   {"server_edit_to_image_ms", h.edit_to_image_ms},
                   {"relight_ms", h.relight_ms},
                   {"encode_ms", h.encode_ms},
                   {"coefficients_applied", h.coefficients_applied},
                   {"coefficients_remaining", h.coefficients_remaining},
                   {"bytes", h.payload_bytes}};
    if (!image.file.empty()) {
        record["file"] = image.file;
    }
    return record;
}

}  // namespace

std::string csv_from_report(const SequenceReport& report) {
    std::string csv =
        "index,time_s,step,sequence,revision,encoding,relative_error,exact,edit_to_image_ms,"
        "server_edit_to_image_ms,relight_ms,encode_ms,coefficients_applied,"
        "coefficients_remaining,bytes,file\n";
    for (std::size_t i = 0; i < report.images.size(); ++i) {
        const ImageRecord& image = report.images[i];
        const wire::ImageHeader& h = image.header;
        const std::string latency = image.edit_to_image_ms.empty()
                                        ? std::string()
                                        : fmt::format("{:.3f}", image.edit_to_image_ms.front());
        csv +=
            fmt::format("{},{:.6f},{},{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{},{},{},{}\n", i,
                        image.time_s, image.step, h.sequence, h.revision, name_of(h.encoding),
                        h.relative_error, h.exact ? 1 : 0, latency, h.edit_to_image_ms,
                        h.relight_ms, h.encode_ms, h.coefficients_applied,
                        h.coefficients_remaining, h.payload_bytes, image.file);
    }
    return csv;
}

json summary_from_report(const SequenceReport& report) {
    std::vector<double> edit_to_image_ms;
    std::vector<double> relight_ms;
    std::uint64_t bytes = 0;
    std::uint64_t coefficients = 0;
    std::size_t moving_images = 0;
    double moving_until_s = 0;
    for (std::size_t i = 0; i < report.images.size(); ++i) {
        const ImageRecord& image = report.images[i];
        edit_to_image_ms.insert(edit_to_image_ms.end(), image.edit_to_image_ms.begin(),
                                image.edit_to_image_ms.end());
        relight_ms.push_back(image.header.relight_ms);
        bytes += image.header.payload_bytes;
        coefficients += image.header.coefficients_applied;
        if (!image.edit_to_image_ms.empty()) {
            moving_images = i;
            moving_until_s = image.time_s;
        }
    }
    const double moving_s =
        report.images.empty() ? 0 : moving_until_s - report.images.front().time_s;
    const bool has_images = !report.images.empty();
    json summary = {
        {"scene", report.scene},
        {"images", report.images.size()},
        {"edits", report.edits},
        {"edits_shown", edit_to_image_ms.size()},
        {"seconds", report.seconds},
        {"images_per_second",
         moving_s > 0 ? json(static_cast<double>(moving_images) / moving_s) : json()},
        {"bytes", bytes},
        {"coefficients_applied", coefficients},
        {"exact", has_images && report.images.back().header.exact},
        {"relative_error",
         has_images ? json(report.images.back().header.relative_error) : json()}};
    put_spread(summary, "edit_to_image_ms", spread_of(std::move(edit_to_image_ms)));
    put_spread(summary, "relight_ms", spread_of(std::move(relight_ms)));
    return summary;
}

json json_from_report(const SequenceReport& report) {
    json images = json::array();
    for (const ImageRecord& image : report.images) {
        images.push_back(json_from_record(image));
    }
    return {{"scene", report.scene},
            {"room", report.room},
            {"rate_hz", report.rate_hz},
            {"images", std::move(images)},
            {"summary", summary_from_report(report)}};
}

}  // namespace relume::cli
