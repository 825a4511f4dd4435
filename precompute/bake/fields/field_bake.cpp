#include "precompute/bake/fields/field_bake.h"

#include "precompute/bake/base/error.h"
#include "protocol/basis/cubemap.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>
#include <string>

namespace relume::bake {
namespace {

// A part lies in memory while it is baked.
std::vector<FieldPart> parts_of(std::uint32_t blocks, std::uint32_t face_resolution) {
    const std::uint32_t most = face_resolution <= 64 ? 64 : 16;
    std::vector<FieldPart> parts;
    for (std::uint32_t first = 0; first < blocks; first += most) {
        parts.push_back({first, std::min(most, blocks - first)});
    }
    return parts;
}

class PartBaker {
  public:
    PartBaker(const RayCaster& caster,
              const FieldSource& source,
              const LightTexels& texels,
              const FieldWork& work)
        : source_(source),
          work_(work),
          visibility_(caster, texels),
          n_(texels.face_resolution()),
          words_(transport::words_of_visibility(n_)) {}

    [[nodiscard]] FinishedPart bake(const FieldPart& part) const {
        transport::VisibilityFieldBuilder visibility(n_, part.block_count);
        transport::SeenPointsBuilder points(part.block_count);
        std::atomic<std::uint64_t> rays = 0;
        std::atomic<std::uint64_t> open = 0;
        tbb::parallel_for(std::uint32_t{0}, part.block_count, [&](std::uint32_t i) {
            FieldBlock block = source_.points_of(part.first_block + i);
            std::vector<std::uint64_t> bits(block.looking.size() * words_);
            rays += look(block.looking, bits);
            std::uint64_t ones = 0;
            for (const std::uint64_t word : bits) {
                ones += static_cast<std::uint64_t>(std::popcount(word));
            }
            open += ones;
            visibility.set_block(i, bits);
            points.set_block(i, block.seen);
        });
        return {.counts = {.points = visibility.point_count(), .open = open, .rays = rays},
                .visibility = visibility.bytes(),
                .points = points.bytes()};
    }

  private:
    // Returns the rays.
    std::uint64_t look(std::span<const LookingPoint> points,
                       std::span<std::uint64_t> bits) const {
        constexpr std::size_t kPointsPerTick = 16;
        PointVisibility::Scratch scratch;
        for (std::size_t first = 0; first < points.size(); first += kPointsPerTick) {
            const std::size_t count = std::min(kPointsPerTick, points.size() - first);
            const std::uint64_t before = scratch.rays;
            for (std::size_t i = first; i < first + count; ++i) {
                visibility_.compute(points[i], bits.subspan(i * words_, words_), scratch);
            }
            if (!work_.tick(count, scratch.rays - before, false)) {
                throw BakeInterrupted("stopped before all of the visibility was finished");
            }
        }
        return scratch.rays;
    }

    const FieldSource& source_;
    const FieldWork& work_;
    PointVisibility visibility_;
    std::uint32_t n_;
    std::size_t words_;
};

void take_over(const FieldPart& part, const FinishedPart& finished, BakedFields& fields) {
    const transport::VisibilityField visibility(finished.visibility, "visibility.bin");
    const transport::SeenPoints points(finished.points, "points.bin",
                                       std::numeric_limits<std::uint8_t>::max());
    tbb::parallel_for(std::uint32_t{0}, part.block_count, [&](std::uint32_t i) {
        std::vector<std::uint64_t> bits;
        visibility.read(i, bits);
        fields.visibility.set_block(part.first_block + i, bits);
        fields.points.set_block(part.first_block + i, points.of_block(i));
    });
}

}  // namespace

std::uint64_t uncompressed_bytes(std::uint64_t points, std::uint32_t face_resolution) {
    return points * transport::words_of_visibility(face_resolution) * sizeof(std::uint64_t);
}

std::string field_bytes_text(std::uint64_t points, std::uint32_t face_resolution) {
    return fmt::format(
        "visibility of {} points, 6×{n}×{n} bits each: {:.1f} MB before compression, after "
        "which it lies in memory once",
        points, static_cast<double>(uncompressed_bytes(points, face_resolution)) / 1e6,
        fmt::arg("n", face_resolution));
}

std::string most_field_bytes_text(std::uint64_t most_vertices, std::uint32_t face_resolution) {
    return fmt::format(
        "visibility of at most {} vertices, 6×{n}×{n} bits each: at most {:.1f} MB, which a "
        "server of triple products holds as they are; files are compressed",
        most_vertices,
        static_cast<double>(uncompressed_bytes(most_vertices, face_resolution)) / 1e6,
        fmt::arg("n", face_resolution));
}

void check_field_bytes(std::uint64_t points,
                       std::uint32_t face_resolution,
                       const char* remedies) {
    const std::uint64_t bytes = uncompressed_bytes(points, face_resolution);
    if (bytes > kMostFieldBytes) {
        throw BakeError(fmt::format(
            "visibility: {} points that see 6×{n}×{n} texels have {:.1f} GB of bits, expected "
            "at most {:.1f} GB: {}",
            points, static_cast<double>(bytes) / 1e9,
            static_cast<double>(kMostFieldBytes) / 1e9, remedies,
            fmt::arg("n", face_resolution)));
    }
}

nlohmann::json json_from_counts(const FieldCounts& counts, std::uint32_t face_resolution) {
    const double texels = static_cast<double>(counts.points) *
                          static_cast<double>(basis::texel_count(face_resolution));
    return {{"points", counts.points},
            {"face_resolution", face_resolution},
            {"open_share", texels > 0 ? static_cast<double>(counts.open) / texels : 0.0}};
}

BakedFields bake_fields(const RayCaster& caster,
                        const FieldSource& source,
                        const LightTexels& texels,
                        const FieldWork& work) {
    BakedFields fields{.visibility = transport::VisibilityFieldBuilder(texels.face_resolution(),
                                                                       source.block_count()),
                       .points = transport::SeenPointsBuilder(source.block_count()),
                       .counts = {}};
    const FieldPartsFolder folder(work.directory, work.fingerprint);
    const PartBaker baker(caster, source, texels, work);
    const std::vector<FieldPart> parts =
        parts_of(source.block_count(), texels.face_resolution());
    for (const FieldPart& part : parts) {
        if (const auto finished = folder.read(part)) {
            work.tick(finished->counts.points, 0, true);
        } else {
            folder.write(part, baker.bake(part));
        }
    }
    for (const FieldPart& part : parts) {
        const auto finished = folder.read(part);
        if (!finished) {
            throw BakeError(work.directory.string() +
                            ": a finished part of the visibility is gone, expected it in "
                            "partial/; bake again");
        }
        take_over(part, *finished, fields);
        fields.counts.points += finished->counts.points;
        fields.counts.open += finished->counts.open;
        fields.counts.rays += finished->counts.rays;
    }
    return fields;
}

}  // namespace relume::bake
