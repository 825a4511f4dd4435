// What many points see of the light, block by block: visibility.bin, and points.bin beside it.
#pragma once

#include "precompute/bake/fields/field_parts.h"
#include "precompute/bake/fields/point_visibility.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/rows/light_texels.h"
#include "protocol/transport/seen_points.h"
#include "protocol/transport/visibility_field.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace relume::bake {

// The points of one block, in the order of their slots.
struct FieldBlock {
    std::vector<LookingPoint> looking;
    std::vector<transport::SeenPoint> seen;  // as many, or none
};

// Points of all blocks. Answers depend on the arguments alone; thread-safe.
class FieldSource {
  public:
    FieldSource() = default;
    FieldSource(const FieldSource&) = delete;
    FieldSource& operator=(const FieldSource&) = delete;
    virtual ~FieldSource() = default;

    [[nodiscard]] virtual std::uint32_t block_count() const = 0;
    [[nodiscard]] virtual std::uint64_t point_count() const = 0;
    [[nodiscard]] virtual FieldBlock points_of(std::uint32_t block) const = 0;
};

// Where a bake of fields takes place.
struct FieldWork {
    std::filesystem::path directory;  // of the transport; finished parts go to partial/
    std::uint64_t fingerprint = 0;
    // Points that are done, by whom they were done, and rays that were cast for them since the
    // last call; asked by any thread. Returns false when the bake should stop.
    std::function<bool(std::uint64_t points, std::uint64_t rays, bool resumed)> tick;
};

struct BakedFields {
    transport::VisibilityFieldBuilder visibility;
    transport::SeenPointsBuilder points;
    FieldCounts counts;  // rays of resumed parts too
};

// Bits before compression that a bake takes at most; compressed they are some five to ten times
// fewer, and lie in memory when the bake ends, and when the scene is served.
inline constexpr std::uint64_t kMostFieldBytes = std::uint64_t{1} << 35U;

[[nodiscard]] std::uint64_t uncompressed_bytes(std::uint64_t points,
                                               std::uint32_t face_resolution);
// The same for people, before the bake begins.
[[nodiscard]] std::string field_bytes_text(std::uint64_t points, std::uint32_t face_resolution);
// The same of the vertices of a surface before there are any: no more than so many.
[[nodiscard]] std::string most_field_bytes_text(std::uint64_t most_vertices,
                                                std::uint32_t face_resolution);
// Throws BakeError, which names `remedies`, where the points have more than kMostFieldBytes.
void check_field_bytes(std::uint64_t points,
                       std::uint32_t face_resolution,
                       const char* remedies);

// As a manifest's `measured` has it: points, n, and the part of the texels that they see.
[[nodiscard]] nlohmann::json json_from_counts(const FieldCounts& counts,
                                              std::uint32_t face_resolution);

// Parts of some blocks, kept as they are finished. The same source gives the same bytes
// on any number of threads, resumed or not. Throws BakeError, BakeInterrupted,
// files::FileError.
[[nodiscard]] BakedFields bake_fields(const RayCaster& caster,
                                      const FieldSource& source,
                                      const LightTexels& texels,
                                      const FieldWork& work);

}  // namespace relume::bake
