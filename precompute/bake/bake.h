// From a scene to a transport directory.
#pragma once

#include "precompute/bake/base/field_request.h"
#include "precompute/bake/base/measured_brdf.h"
#include "precompute/bake/base/parameters.h"
#include "precompute/bake/curves/edited_material.h"
#include "precompute/bake/curves/frozen_light.h"
#include "precompute/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace relume::bake {

// Of the two sketches of every bake.
inline constexpr std::uint32_t kStatingRows = 128;
inline constexpr std::uint32_t kChoosingRows = 64;

// Rows first, and then what points see of the light, where that is asked for.
enum class BakeStage : std::uint8_t { rows, visibility };

struct BakeProgress {
    BakeStage stage = BakeStage::rows;
    // Receivers that have rows, or points that see the light.
    std::uint64_t receivers_done = 0;  // resumed ones included
    std::uint64_t receivers_resumed = 0;
    std::uint64_t receivers = 0;
    std::uint64_t rays = 0;
};

struct BakeHooks {
    // Told what the bake is about to do, in words: one line each, before the first receiver.
    std::function<void(const std::string&)> on_note{};
    // Called from time to time, by one thread at a time.
    std::function<void(const BakeProgress&)> on_progress{};
    // Asked from time to time, by any thread. When it says true the bake ends with
    // BakeInterrupted, and the shards that are finished stay.
    std::function<bool()> should_stop{};
};

// How it went; the rest is in the manifest.
struct BakeSummary {
    double seconds = 0;
    double pilot_seconds = 0;
    double path_seconds = 0;    // camera rays and path tracing
    double row_seconds = 0;     // visibility, projection, quantisation, encoding
    double field_seconds = 0;   // visibility of points
    double finish_seconds = 0;  // column tables, manifest, view
    double cpu_seconds = 0;     // of paths and rows: the process's, whatever else it does
    std::uint64_t visibility_rays = 0;
    std::uint64_t path_rays = 0;
    std::uint64_t field_rays = 0;
    std::uint64_t field_points = 0;
    std::uint64_t field_points_resumed = 0;
    std::uint32_t shards = 0;
    std::uint32_t shards_resumed = 0;
    std::uint64_t peak_memory_bytes = 0;
};

// The curves that an image is to answer to, and the light that is frozen in it.
struct CurveEdits {
    FrozenLight light;
    std::vector<EditedMaterial> materials;  // 1 … 16
};

// Bakes an image of the scene seen by its own camera into `directory`, which is made or
// continued: shards of a bake of the same inputs that was interrupted are kept. The same inputs
// give the same bytes on any number of threads. Memory stays bounded by a shard's rows of paths
// and the non-zero values of the blocks in work. Of receivers that are vertices, `measured`
// BRDFs take the place of what the scene says of their materials. `fields` asks for more files
// beside the light, which has the same bits with and without them; they are baked after the
// shards, and resumed as these are. Throws BakeError, BakeInterrupted, scene::SceneError,
// transport::TransportError, files::FileError, program::UsageError.
BakeSummary bake(const scene::Scene& scene,
                 const BakeParameters& parameters,
                 const std::filesystem::path& directory,
                 const BakeHooks& hooks = {},
                 std::span<const MeasuredBrdf> measured = {},
                 const FieldRequest& fields = {});

// The same of an image of pixels that answers to curves. The light is of the resolution of the
// parameters, and their basis is Haar's; throws program::UsageError where they ask for
// something else. `measured` are of edited materials.
BakeSummary bake_curves(const scene::Scene& scene,
                        const BakeParameters& parameters,
                        const CurveEdits& edits,
                        const std::filesystem::path& directory,
                        const BakeHooks& hooks = {},
                        std::span<const MeasuredBrdf> measured = {});

}  // namespace relume::bake
