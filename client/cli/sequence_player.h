// Plays a script against a server in real time and records what comes back.
#pragma once

#include "client/cli/room_connection.h"
#include "client/cli/sequence_report.h"
#include "client/cli/sequence_script.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace relume::cli {

// jpeg: all as .jpg; png: all as .png; exr: linear images as .exr, the others as .jpg.
enum class ImageFiles { none, jpeg, png, exr };

struct SequenceProgress {
    std::size_t step = 0;  // being played
    std::size_t steps = 0;
    std::size_t edits = 0;
    std::size_t images = 0;
    double relative_error = 0;  // stated by the last image
};

struct SequenceOptions {
    ConnectionOptions connection;
    SequenceScript script;
    double rate_hz = 30;
    ImageFiles files = ImageFiles::none;
    std::filesystem::path folder;  // exists, unless files is none
    // Called after every image.
    std::function<void(const SequenceProgress&)> on_progress;
};

// The start patch is sent first and waited for; images and times count from the first step on.
// After the last step it waits until the last edit is shown. Throws ClientError when an edit is
// refused, the connection ends early, or a rest runs out of time.
[[nodiscard]] SequenceReport play_sequence(const SequenceOptions& options);

}  // namespace relume::cli
