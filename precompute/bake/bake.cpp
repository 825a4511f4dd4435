#include "precompute/bake/bake.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/blocks/shard_baker.h"
#include "precompute/bake/curve_subject.h"
#include "precompute/bake/image_subject.h"
#include "precompute/bake/mesh/mesh_subject.h"
#include "precompute/bake/peak_memory.h"
#include "precompute/bake/rows/traced_receivers.h"
#include "precompute/bake/version.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/transport/transport_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <array>
#include <atomic>
#include <ctime>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

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
    ProgressCounter(const BakeHooks& hooks, std::uint64_t receivers) : hooks_(hooks) {
        progress_.receivers = receivers;
    }

    // Goes on to the visibility of so many points.
    void begin_visibility(std::uint64_t points) {
        const std::scoped_lock lock(mutex_);
        progress_ = {.stage = BakeStage::visibility, .receivers = points};
    }

    // False when the bake should stop.
    bool add(std::uint64_t receivers, std::uint64_t rays) {
        if (hooks_.on_progress) {
            const std::scoped_lock lock(mutex_);
            progress_.receivers_done += receivers;
            progress_.rays += rays;
            hooks_.on_progress(progress_);
        }
        return !(hooks_.should_stop && hooks_.should_stop());
    }
    void add_resumed(std::uint64_t receivers) {
        const std::scoped_lock lock(mutex_);
        progress_.receivers_done += receivers;
        progress_.receivers_resumed += receivers;
    }

  private:
    const BakeHooks& hooks_;
    std::mutex mutex_;
    BakeProgress progress_;
};

std::uint64_t receivers_in(const Receivers& receivers, const ShardClusters& shard) {
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i < shard.cluster_count; ++i) {
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            count += receivers.receiver_at(shard.first_cluster + i, slot) ? 1U : 0U;
        }
    }
    return count;
}

transport::ShardPlan plan_of(std::span<const ShardClusters> shards) {
    transport::ShardPlan plan;
    for (const ShardClusters& shard : shards) {
        plan.add(shard.block_count);
    }
    return plan;
}

std::unique_ptr<BakeSubject> make_subject(const RayCaster& caster,
                                          const BakeParameters& parameters,
                                          const CurveEdits* edits,
                                          std::span<const MeasuredBrdf> measured,
                                          const FieldRequest& fields,
                                          const BakeHooks& hooks) {
    if (edits != nullptr) {
        return std::make_unique<CurveSubject>(caster, parameters, edits->light,
                                              edits->materials);
    }
    if (parameters.receivers == ReceiverKind::vertices) {
        return std::make_unique<MeshSubject>(caster, parameters, measured, hooks.should_stop,
                                             fields);
    }
    return std::make_unique<ImageSubject>(caster, parameters, fields);
}

class Bake {
  public:
    Bake(const scene::Scene& scene,
         const BakeParameters& parameters,
         const CurveEdits* edits,
         const std::filesystem::path& directory,
         std::span<const MeasuredBrdf> measured,
         const FieldRequest& fields,
         const BakeHooks& hooks)
        : parameters_(parameters),
          directory_(directory),
          caster_(scene),
          subject_(make_subject(caster_, parameters, edits, measured, fields, hooks)),
          progress_(hooks, subject_->receivers().receiver_count()) {
        TracedReceivers::check_memory(subject_->receivers(), parameters);
        subject_->check();
        if (const auto points = subject_->field_point_count(); points && hooks.on_note) {
            hooks.on_note(field_bytes_text(*points, fields.resolution_of(parameters)));
        }
        rows_ = subject_->rows();
        manifest_.generator = generator();
        manifest_.bake = json_from_parameters(parameters);
        manifest_.bake["scene"] = scene.name;
        manifest_.bake["triangles"] = scene.triangle_count();
        for (const MeasuredBrdf& one : measured) {
            manifest_.bake["measured"][one.material] = one.file.filename().string();
        }
        subject_->describe(manifest_);
        manifest_.stating_rows = kStatingRows;
        manifest_.choosing_rows = kChoosingRows;
    }

    BakeSummary run() {
        const timing::Stopwatch stopwatch;
        const Receivers& receivers = subject_->receivers();
        {
            const AddedTime adding(summary_.pilot_seconds);
            quantisation_ = plan_quantisation(*rows_, parameters_.bits, parameters_.seed);
        }
        manifest_.colour = quantisation_.colour;
        manifest_.block_basis = quantisation_.block_basis;
        shards_ = shards_of(receivers);
        transport::TransportWriter writer(directory_, manifest_, plan_of(shards_));
        const ShardNotesFolder notes(directory_, manifest_.fingerprint);
        summary_.shards = writer.plan().shard_count();
        const ShardBaker shards(*rows_, quantisation_, parameters_.seed);
        for (std::uint32_t shard = 0; shard < summary_.shards; ++shard) {
            bake_shard(shard, shards, writer, notes);
        }
        if (subject_->field_point_count()) {
            const AddedTime adding(summary_.field_seconds);
            bake_fields();
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
        const ShardClusters& clusters = shards_[shard];
        if (writer.has_shard(shard) && notes.read(shard, clusters)) {
            ++summary_.shards_resumed;
            progress_.add_resumed(receivers_in(subject_->receivers(), clusters));
            return;
        }
        const CpuWatch cpu(summary_.cpu_seconds);
        {
            const AddedTime adding(summary_.path_seconds);
            summary_.path_rays +=
                rows_->move_to(clusters.first_cluster, clusters.cluster_count);
        }
        const AddedTime adding(summary_.row_seconds);
        const BakedShard baked =
            shards.bake(clusters, [&](std::uint64_t receivers, std::uint64_t rays) {
                return progress_.add(receivers, rays);
            });
        summary_.visibility_rays += baked.rays;
        notes.write(shard, baked.notes);
        writer.write_shard(shard, baked.blocks);
    }

    void bake_fields() {
        summary_.field_points = subject_->field_point_count().value();
        progress_.begin_visibility(summary_.field_points);
        std::atomic<std::uint64_t> all_rays = 0;
        subject_->bake_fields(
            {.directory = directory_,
             .fingerprint = manifest_.fingerprint,
             .tick = [&](std::uint64_t points, std::uint64_t rays, bool resumed) {
                 if (resumed) {
                     summary_.field_points_resumed += points;
                     progress_.add_resumed(points);
                     return true;
                 }
                 all_rays += rays;
                 return progress_.add(points, rays);
             }});
        summary_.field_rays = all_rays;
    }

    void finish(transport::TransportWriter& writer, const ShardNotesFolder& notes) {
        transport::BakedTables tables{.steps = quantisation_.steps, .coverage = {}, .tint = {}};
        std::vector<BlockErrors> errors;
        std::vector<ClusterSample> samples;
        for (std::uint32_t shard = 0; shard < summary_.shards; ++shard) {
            const auto noted = notes.read(shard, shards_[shard]);
            if (!noted) {
                throw BakeError(directory_.string() +
                                ": the notes of a finished shard are gone, expected them in "
                                "partial/; bake again");
            }
            tables.tint.insert(tables.tint.end(), noted->tint.begin(), noted->tint.end());
            errors.insert(errors.end(), noted->errors.begin(), noted->errors.end());
            samples.insert(samples.end(), noted->samples.begin(), noted->samples.end());
        }
        tables.coverage = coverage_of_slots();
        writer.state_sampling_error(subject_->sampling_error(samples));
        subject_->write_tables(writer);
        nlohmann::json measured = subject_->measured();
        measured["quantisation_error"] = json_from_errors(errors);
        measured["chroma_residual"] = quantisation_.chroma_residual;
        for (const auto& [basis, bytes] : quantisation_.bytes_of_basis) {
            const std::string name(transport::kBlockBasisNames.name(basis));
            measured["bytes_of_basis"][name] = bytes;
        }
        writer.finish(tables, measured);
        notes.remove();
        subject_->write_files(directory_);
    }

    // [blocks][256].
    [[nodiscard]] std::vector<float> coverage_of_slots() {
        const Receivers& receivers = subject_->receivers();
        const std::vector<float> coverage = subject_->coverage();
        std::vector<float> slots;
        for (std::uint32_t cluster = 0; cluster < receivers.cluster_count(); ++cluster) {
            std::array<float, transport::kBlockSize> of_cluster{};
            for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
                if (const auto receiver = receivers.receiver_at(cluster, slot)) {
                    of_cluster[slot] = coverage[*receiver];
                }
            }
            for (std::uint32_t term = 0; term < receivers.terms(cluster); ++term) {
                slots.insert(slots.end(), of_cluster.begin(), of_cluster.end());
            }
        }
        return slots;
    }

    BakeParameters parameters_;
    std::filesystem::path directory_;
    RayCaster caster_;
    std::unique_ptr<BakeSubject> subject_;
    std::unique_ptr<RowSource> rows_;
    ProgressCounter progress_;
    transport::Manifest manifest_;
    Quantisation quantisation_;
    std::vector<ShardClusters> shards_;
    BakeSummary summary_;
};

BakeSummary run_bake(const scene::Scene& scene,
                     const BakeParameters& parameters,
                     const CurveEdits* edits,
                     const std::filesystem::path& directory,
                     std::span<const MeasuredBrdf> measured,
                     const FieldRequest& fields,
                     const BakeHooks& hooks) {
    std::optional<tbb::global_control> limit;
    if (parameters.threads > 0) {
        limit.emplace(tbb::global_control::max_allowed_parallelism, parameters.threads);
    }
    // What an image's points are is known soon, and said then. A surface is refined first.
    if (fields.of_vertices && hooks.on_note) {
        hooks.on_note(
            most_field_bytes_text(parameters.vertices, fields.resolution_of(parameters)));
    }
    if (measured.empty()) {
        return Bake(scene, parameters, edits, directory, measured, fields, hooks).run();
    }
    const scene::Scene seen_by_paths = scene_with_albedos(scene, measured);
    return Bake(seen_by_paths, parameters, edits, directory, measured, fields, hooks).run();
}

}  // namespace

BakeSummary bake(const scene::Scene& scene,
                 const BakeParameters& parameters,
                 const std::filesystem::path& directory,
                 const BakeHooks& hooks,
                 std::span<const MeasuredBrdf> measured,
                 const FieldRequest& fields) {
    check_parameters(parameters);
    check_fields(fields, parameters);
    if (!measured.empty() && parameters.receivers != ReceiverKind::vertices) {
        throw program::UsageError(
            fmt::format("'{}' is to reflect as was measured: expected receivers that are "
                        "vertices, or --edit "
                        "beside it",
                        measured.front().material));
    }
    return run_bake(scene, parameters, nullptr, directory, measured, fields, hooks);
}

BakeSummary bake_curves(const scene::Scene& scene,
                        const BakeParameters& parameters,
                        const CurveEdits& edits,
                        const std::filesystem::path& directory,
                        const BakeHooks& hooks,
                        std::span<const MeasuredBrdf> measured) {
    check_parameters(parameters);
    if (parameters.receivers != ReceiverKind::pixels ||
        parameters.basis != basis::CubemapBasis::Kind::haar ||
        parameters.face_resolution != edits.light.cubemap.face_resolution) {
        throw program::UsageError(
            "curves are baked for the pixels of an image under the texels of a cubemap, "
            "expected "
            "neither --receivers vertices nor --basis sh beside --edit");
    }
    return run_bake(scene, parameters, &edits, directory, measured, {}, hooks);
}

}  // namespace relume::bake
