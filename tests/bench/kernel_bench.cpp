// The kernels by themselves: columns of every encoding, and whole products, on every
// instruction set this processor has, from the second-level cache and from memory.
#include "server/engine/kernels/target.h"
#include "tests/bench/cell_stream.h"
#include "tests/bench/strip_stream.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <hwy/targets.h>

#include <cctype>
#include <cstdlib>
#include <optional>

namespace relume::bench {
namespace {

// One shard of 64 blocks: 200 KB of sums.
constexpr std::uint32_t kBlocks = transport::kMaxBlocksPerShard;

struct Working {
    const char* name;
    std::size_t bytes;
};
constexpr Working kWorkingSets[] = {{"l2", std::size_t{512} << 10U},
                                    {"memory", std::size_t{192} << 20U}};

benchmark::Counter per_second(std::uint64_t amount) {
    return {static_cast<double>(amount), benchmark::Counter::kIsIterationInvariantRate};
}

benchmark::Counter seconds_per(std::uint64_t amount) {
    return {static_cast<double>(amount),
            benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

// Without a target: the specification, which RELUME_FORCE_TARGET=scalar runs. (Highway calls
// the processor's plain instructions a target named scalar, too.)
void run_kernel(benchmark::State& state,
                const CellKind& kind,
                std::size_t bytes,
                std::optional<std::int64_t> target) {
    const CellStream stream(kind, kBlocks, bytes);
    std::vector<float> sums(std::size_t{kBlocks} * transport::kColours * transport::kBlockSize);
    hwy::SetSupportedTargetsForTest(target.value_or(0));
    engine::AccumulateSegments* const kernel =
        target ? engine::accumulate_segments : engine::accumulate_segments_scalar;
    for (auto _ : state) {
        kernel(stream.segments(), kBlocks, {.sums = sums.data(), .total = nullptr});
        benchmark::ClobberMemory();
    }
    hwy::SetSupportedTargetsForTest(0);
    state.counters["bytes/s"] = per_second(stream.bytes());
    state.counters["s/cell"] = seconds_per(stream.cells());
    if (stream.nonzeros() != 0) {
        state.counters["s/value"] = seconds_per(stream.nonzeros());
    }
}

void run_strip_product(benchmark::State& state,
                       const StripKind& kind,
                       std::size_t bytes,
                       std::optional<std::int64_t> target) {
    const StripStream stream(kind, bytes);
    const StripTargets targets(kind.targets);
    hwy::SetSupportedTargetsForTest(target.value_or(0));
    engine::MultiplyStrips<std::int8_t>* const kernel =
        target ? engine::multiply_strips : engine::multiply_strips_scalar;
    for (auto _ : state) {
        for (std::size_t run = 0; run < stream.run_count(); ++run) {
            kernel(stream.run(run), targets.all());
        }
        benchmark::ClobberMemory();
    }
    hwy::SetSupportedTargetsForTest(0);
    state.counters["bytes/s"] = per_second(stream.bytes());
    state.counters["s/strip"] = seconds_per(stream.strips() * kind.targets);
}

// `run` as TARGET/WORKING SET/KIND.
template <typename Kind>
void register_kind(
    void (*run)(benchmark::State&, const Kind&, std::size_t, std::optional<std::int64_t>),
    const std::string& target_name,
    std::optional<std::int64_t> target,
    const Working& working,
    const Kind& kind) {
    const std::string name = fmt::format("{}/{}/{}", target_name, working.name, kind.name);
    const std::size_t bytes = working.bytes;
    benchmark::RegisterBenchmark(name.c_str(), [=, &kind](benchmark::State& state) {
        run(state, kind, bytes, target);
    })->Unit(benchmark::kMicrosecond);
}

void register_kernels(const std::string& target_name, std::optional<std::int64_t> target) {
    for (const Working& working : kWorkingSets) {
        for (const CellKind& kind : cell_kinds()) {
            // Tags alone cannot fill the memory: 32 bytes a column.
            if (kind.nonzeros != 0 || working.bytes == kWorkingSets[0].bytes) {
                register_kind(run_kernel, target_name, target, working, kind);
            }
        }
        for (const StripKind& kind : strip_kinds()) {
            register_kind(run_strip_product, target_name, target, working, kind);
        }
    }
}

std::string lower(std::string text) {
    for (char& letter : text) {
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return text;
}

// All targets, or what RELUME_FORCE_TARGET names.
void register_all() {
    const bool forced = std::getenv("RELUME_FORCE_TARGET") != nullptr;
    const std::string chosen = engine::target_name();
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        const std::string name = lower(hwy::TargetName(target));
        if (!forced || name == chosen) {
            register_kernels(name, target);
        }
    }
    if (!forced || engine::scalar_is_forced()) {
        register_kernels("specification", std::nullopt);
    }
    benchmark::AddCustomContext("kernel target by default", chosen);
}

}  // namespace
}  // namespace relume::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    relume::bench::register_all();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
