// A sequence of edits: what is edited when. README.md of this folder has the schema.
#pragma once

#include "client/cli/camera_path.h"
#include "client/cli/finish_change.h"
#include "client/cli/material_change.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace relume::cli {

enum class Ease : std::uint8_t { linear, slow_fast_slow, slow_fast, fast_slow };

// The way covered at time t, both 0 … 1; monotonic, ends exact.
[[nodiscard]] double eased(Ease ease, double t);

struct Span {
    double from = 0;
    double to = 0;

    [[nodiscard]] double at(double way) const { return from + (to - from) * way; }
};

// Steps that last: one edit per image, `images` of them, the last one at the end of the way.
struct Rotate {
    Span yaw_degrees;
    Span pitch_degrees;
    Span roll_degrees;
    std::uint32_t images = 1;
    Ease ease = Ease::linear;
};
struct MoveLight {
    std::string id;
    Imath::V3d from;  // unit directions; the way between them is a great circle
    Imath::V3d to;
    std::uint32_t images = 1;
    Ease ease = Ease::linear;
};
struct BlendOver {
    std::string name;
    Span amount;
    std::uint32_t images = 1;
    Ease ease = Ease::linear;
};
struct MoveCamera {
    CameraPath path;
    std::uint32_t images = 2;
    Ease ease = Ease::linear;
};
struct ChangeMaterial {
    MaterialChange change;
    std::uint32_t images = 1;
    Ease ease = Ease::linear;
};
struct ChangeFinish {
    FinishChange change;
    std::uint32_t images = 1;
    Ease ease = Ease::linear;
};
// One edit.
struct ApplyPatch {
    nlohmann::json patch;
};
// No edit, until an exact image of all edits so far has come or for a time.
struct Rest {
    std::optional<double> seconds;  // none: until exact
    double timeout_seconds = 300;   // how long to wait for exact
};
using Step = std::variant<Rotate,
                          MoveLight,
                          BlendOver,
                          MoveCamera,
                          ChangeMaterial,
                          ChangeFinish,
                          ApplyPatch,
                          Rest>;

struct SequenceScript {
    std::string scene;                                // may be empty
    nlohmann::json start = nlohmann::json::object();  // the state to begin with, a patch
    std::vector<Step> steps;
};

inline constexpr std::uint32_t kMaxStepImages = 1'000'000;
inline constexpr std::size_t kMaxSteps = 10'000;
inline constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 20;

// Throws ClientError with a JSON pointer to what is wrong, what was found and expected.
[[nodiscard]] SequenceScript sequence_script_from_text(std::string_view text);

// How many edits a step sends; a rest sends none.
[[nodiscard]] std::uint32_t edit_count(const Step& step);
// The edit of image `index` in [0, edit_count).
[[nodiscard]] nlohmann::json patch_of(const Step& step, std::uint32_t index);

}  // namespace relume::cli
