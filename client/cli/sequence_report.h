// What a played sequence measured, image by image and as a whole.
#pragma once

#include "protocol/wire/image_header.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace relume::cli {

struct ImageRecord {
    double time_s = 0;     // of receipt, since the first step began
    std::size_t step = 0;  // being played when it came
    wire::ImageHeader header;
    // Of the edits that this image was the first to show, oldest first.
    std::vector<double> edit_to_image_ms;
    std::string file;  // name in the output folder; empty when not written
};

struct SequenceReport {
    std::string scene;
    std::string room;
    double rate_hz = 0;
    double seconds = 0;
    std::size_t edits = 0;
    std::vector<ImageRecord> images;
};

// One header line, then a line per image. `edit_to_image_ms` is that of the oldest edit the
// image is the first to show, measured here; `server_edit_to_image_ms` is the header's.
[[nodiscard]] std::string csv_from_report(const SequenceReport& report);
// {"scene","room","rate_hz","images":[…],"summary":{…}}
[[nodiscard]] nlohmann::json json_from_report(const SequenceReport& report);
// "images", "images_per_second" (from the first image to the last that shows an edit),
// "edit_to_image_ms_p50" …, "exact" (of the last image), …
[[nodiscard]] nlohmann::json summary_from_report(const SequenceReport& report);

}  // namespace relume::cli
