#include "precompute/bake/bake.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/blocks/shard_baker.h"
#include "precompute/bake/fingerprint.h"
#include "precompute/bake/framing.h"
#include "precompute/bake/peak_memory.h"
#include "precompute/bake/version.h"
#include "precompute/bake/view_files.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/transport/transport_writer.h"

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <mutex>
#include <optional>

namespace relume::bake {
namespace {

// Adds to a total, in seconds, the time from when it is made until it is destroyed.
class AddedTime {
  public:
    explicit AddedTime(double& total) : total_(total) {}
    AddedTime(const AddedTime&) = delete;
    AddedTime& operator=(const AddedTime&) = delete;
    ~AddedTime() { total_ += stopwatch_.seconds(); }

  private:
    double& total_;
    timing::Stopwatch stopwatch_;
};

// Whole tile rows where one fits into a shard, else a part of a row.
transport::ShardPlan plan_shards(const transport::TileGrid& image) {
    const std::uint32_t rows = transport::kMaxBlocksPerShard / image.tiles_x();
    return {
        .block_count = image.block_count(),
        .blocks_per_shard = rows > 0 ? rows * image.tiles_x() : transport::kMaxBlocksPerShard};
}

transport::CameraRecord record_of(const scene::Camera& camera, const scene::WorldFrame& frame) {
    return {.eye = Imath::V3f(frame.world_from_position(camera.eye())),
            .right = camera.right(),
            .up = camera.up(),
            .forward = camera.forward(),
            .tan_half_width = camera.tan_half_width(),
            .tan_half_height = camera.tan_half_height()};
}

// Adds the processor time of all threads until it is destroyed.
class CpuWatch {
  public:
    explicit CpuWatch(double& total) : total_(total) {}
    CpuWatch(const CpuWatch&) = delete;
    CpuWatch& operator=(const CpuWatch&) = delete;
    ~CpuWatch() {
        total_ += static_cast<double>(std::clock() - start_) / double{CLOCKS_PER_SEC};
    }

  private:
    double& total_;
    std::clock_t start_ = std::clock();
};

class ProgressCounter {
  public:
    ProgressCounter(const BakeHooks& hooks, std::uint64_t pixels) : hooks_(hooks) {
        progress_.pixels = pixels;
    }

    // False when the bake should stop.
    bool add(std::uint64_t pixels, std::uint64_t rays) {
        if (hooks_.on_progress) {
            const std::scoped_lock lock(mutex_);
            progress_.pixels_done += pixels;
            progress_.rays += rays;
            hooks_.on_progress(progress_);
        }
        return !(hooks_.should_stop && hooks_.should_stop());
    }
    void add_resumed(std::uint64_t pixels) {
        const std::scoped_lock lock(mutex_);
        progress_.pixels_done += pixels;
        progress_.pixels_resumed += pixels;
    }

  private:
    const BakeHooks& hooks_;
    std::mutex mutex_;
    BakeProgress progress_;
};

std::uint64_t pixels_in(const transport::TileGrid& image,
                        std::uint32_t first_block,
                        std::uint32_t block_count) {
    std::uint64_t pixels = 0;
    for (std::uint32_t block = first_block; block < first_block + block_count; ++block) {
        const std::uint32_t left = block % image.tiles_x() * transport::kTileSide;
        const std::uint32_t top = block / image.tiles_x() * transport::kTileSide;
        pixels += std::uint64_t{std::min(transport::kTileSide, image.width - left)} *
                  std::min(transport::kTileSide, image.height - top);
    }
    return pixels;
}

class Bake {
  public:
    Bake(const scene::Scene& scene,
         const BakeParameters& parameters,
         const std::filesystem::path& directory,
         const BakeHooks& hooks)
        : parameters_(parameters),
          directory_(directory),
          image_{.width = parameters.width, .height = parameters.height},
          camera_(scene.camera, parameters.width, parameters.height),
          caster_(scene),
          texels_(parameters.face_resolution, parameters.seed),
          window_(caster_, camera_, parameters_),
          rows_(caster_, texels_, parameters_),
          progress_(hooks, std::uint64_t{parameters.width} * parameters.height) {
        check_framing(caster_, camera_, parameters);
        manifest_.generator = generator();
        manifest_.fingerprint = fingerprint_of(scene, camera_, parameters, generator());
        manifest_.layout = transport::ReceiverLayout::pixel_tiles(image_);
        manifest_.signal_basis = signal_basis(parameters);
        manifest_.stating_rows = kStatingRows;
        manifest_.choosing_rows = kChoosingRows;
        manifest_.camera = record_of(camera_, scene.frame);
        manifest_.bake = json_from_parameters(parameters);
        manifest_.bake["scene"] = scene.name;
        manifest_.bake["triangles"] = scene.triangle_count();
    }

    BakeSummary run() {
        const timing::Stopwatch stopwatch;
        {
            const AddedTime adding(summary_.pilot_seconds);
            quantisation_ = plan_quantisation(rows_, window_, image_, parameters_);
            manifest_.sampling_error = measure_sampling_error(caster_, camera_, parameters_);
        }
        manifest_.colour = quantisation_.colour;
        transport::TransportWriter writer(directory_, manifest_, plan_shards(image_));
        const ShardNotesFolder notes(directory_, manifest_.fingerprint);
        summary_.shards = writer.plan().shard_count();
        const ShardBaker shards(rows_, window_, image_, quantisation_, parameters_);
        for (std::uint32_t shard = 0; shard < summary_.shards; ++shard) {
            bake_shard(shard, shards, writer, notes);
        }
        {
            const AddedTime adding(summary_.finish_seconds);
            finish(writer, notes);
        }
        summary_.seconds = stopwatch.seconds();
        summary_.peak_memory_bytes = peak_memory_bytes();
        return summary_;
    }

  private:
    void bake_shard(std::uint32_t shard,
                    const ShardBaker& shards,
                    const transport::TransportWriter& writer,
                    const ShardNotesFolder& notes) {
        const std::uint32_t first = writer.plan().first_block(shard);
        const std::uint32_t count = writer.plan().blocks_in(shard);
        if (writer.has_shard(shard) && notes.read(shard, count)) {
            ++summary_.shards_resumed;
            progress_.add_resumed(pixels_in(image_, first, count));
            return;
        }
        const CpuWatch cpu(summary_.cpu_seconds);
        {
            const AddedTime adding(summary_.path_seconds);
            const std::uint32_t last_row = (first + count - 1) / image_.tiles_x() + 1;
            const std::uint64_t rays =
                window_.move_to(first / image_.tiles_x() * transport::kTileSide,
                                std::min(last_row * transport::kTileSide, image_.height));
            summary_.path_rays += rays;
        }
        const AddedTime adding(summary_.row_seconds);
        const BakedShard baked =
            shards.bake(first, count, [&](std::uint64_t pixels, std::uint64_t rays) {
                return progress_.add(pixels, rays);
            });
        summary_.visibility_rays += baked.rays;
        notes.write(shard, baked.notes);
        writer.write_shard(shard, baked.blocks);
    }

    void finish(transport::TransportWriter& writer, const ShardNotesFolder& notes) {
        transport::BakedTables tables{.steps = quantisation_.steps, .coverage = {}, .tint = {}};
        std::vector<BlockErrors> errors;
        for (std::uint32_t shard = 0; shard < summary_.shards; ++shard) {
            const auto noted = notes.read(shard, writer.plan().blocks_in(shard));
            if (!noted) {
                throw BakeError(directory_.string() +
                                ": the notes of a finished shard are gone, expected them in "
                                "partial/; bake again");
            }
            tables.tint.insert(tables.tint.end(), noted->tint.begin(), noted->tint.end());
            errors.insert(errors.end(), noted->errors.begin(), noted->errors.end());
        }
        const ViewImages view = view_images(caster_, camera_, parameters_);
        tables.coverage.assign(std::size_t{image_.block_count()} * transport::kBlockSize, 0);
        for (std::uint32_t y = 0; y < image_.height; ++y) {
            for (std::uint32_t x = 0; x < image_.width; ++x) {
                const transport::ReceiverPlace at = image_.place_from_pixel(x, y);
                tables.coverage[std::size_t{at.block} * transport::kBlockSize + at.slot] =
                    view.coverage[std::size_t{y} * image_.width + x];
            }
        }
        writer.finish(tables, {{"quantisation_error", json_from_errors(errors)},
                               {"chroma_residual", quantisation_.chroma_residual}});
        notes.remove();
        write_view_files(directory_, view);
    }

    BakeParameters parameters_;
    std::filesystem::path directory_;
    transport::TileGrid image_;
    scene::Camera camera_;
    RayCaster caster_;
    LightTexels texels_;
    TileWindow window_;
    RowBaker rows_;
    ProgressCounter progress_;
    transport::Manifest manifest_;
    Quantisation quantisation_;
    BakeSummary summary_;
};

}  // namespace

BakeSummary bake(const scene::Scene& scene,
                 const BakeParameters& parameters,
                 const std::filesystem::path& directory,
                 const BakeHooks& hooks) {
    check_parameters(parameters);
    std::optional<tbb::global_control> limit;
    if (parameters.threads > 0) {
        limit.emplace(tbb::global_control::max_allowed_parallelism, parameters.threads);
    }
    return Bake(scene, parameters, directory, hooks).run();
}

}  // namespace relume::bake
