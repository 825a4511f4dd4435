// The bake of receivers that are no pixels: ten points on a floor, in two clusters, whose
// neighbours are those along edges drawn by hand.
#include "precompute/bake/receivers/receivers.h"

#include "precompute/bake/blocks/block_encoder.h"
#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/blocks/shard_baker.h"
#include "precompute/bake/rows/path_pool.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/scene/builtin.h"
#include "protocol/transport/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace relume::bake {
namespace {

constexpr std::size_t kPoints = 10;
constexpr std::array<std::size_t, 3> kFirstOfCluster{0, 6, kPoints};
constexpr ShardClusters kBothClusters{.cluster_count = 2, .block_count = 2};
// 0–1–2–…–9, and 2–7 across the clusters.
const std::array<std::vector<std::size_t>, kPoints> kEdges{
    {{1}, {0, 2}, {1, 3, 7}, {2, 4}, {3, 5}, {4, 6}, {5, 7}, {2, 6, 8}, {7, 9}, {8}}};

class FloorPoints final : public Receivers {
  public:
    explicit FloorPoints(const RayCaster& caster) : caster_(caster) {
        const Imath::Box3f bounds = caster.scene().bounds();
        spacing_ = 0.015F * bounds.size().x;
        corner_ = bounds.min + Imath::V3f(0.4F, 0.03F, 0.9F) * bounds.size();
    }

    [[nodiscard]] std::size_t receiver_count() const override { return kPoints; }
    [[nodiscard]] std::uint32_t cluster_count() const override { return 2; }
    [[nodiscard]] std::uint32_t terms(std::uint32_t /*cluster*/) const override { return 1; }
    [[nodiscard]] std::span<const transport::BlockBasis> block_bases() const override {
        static constexpr std::array kBases{transport::BlockBasis::haar_line,
                                           transport::BlockBasis::identity};
        return kBases;
    }
    [[nodiscard]] std::uint32_t clusters_per_shard() const override { return 1; }
    // In every other slot.
    [[nodiscard]] std::optional<std::size_t> receiver_at(std::uint32_t cluster,
                                                         std::uint32_t slot) const override {
        const std::size_t receiver = kFirstOfCluster.at(cluster) + slot / 2;
        return slot % 2 == 1 && receiver < kFirstOfCluster.at(cluster + 1)
                   ? std::optional(receiver)
                   : std::nullopt;
    }
    [[nodiscard]] Receiver look(std::size_t receiver) const override {
        ++looks_.at(receiver);
        return point(receiver, static_cast<std::uint32_t>(receiver));
    }
    [[nodiscard]] std::vector<Receiver> points(std::size_t receiver,
                                               std::uint64_t seed) const override {
        const std::uint64_t run = transport::mix_bits(seed + receiver) % 4096;
        return {point(receiver, static_cast<std::uint32_t>(run))};
    }
    void find_neighbours(std::size_t receiver,
                         std::uint32_t /*radius*/,
                         std::vector<Neighbour>& neighbours) const override {
        neighbours.assign({{.receiver = receiver, .squared_distance = 0}});
        for (const std::size_t other : kEdges.at(receiver)) {
            neighbours.push_back({.receiver = other, .squared_distance = 1});
        }
    }
    [[nodiscard]] std::vector<ReceiverRun> reach(std::uint32_t first_cluster,
                                                 std::uint32_t cluster_count,
                                                 std::uint32_t /*radius*/) const override {
        if (cluster_count == 2) {
            return {{.first = 0, .last = kPoints}};
        }
        return first_cluster == 0 ? std::vector<ReceiverRun>{{.first = 0, .last = 8}}
                                  : std::vector<ReceiverRun>{{.first = 2, .last = 3},
                                                             {.first = 5, .last = kPoints}};
    }
    [[nodiscard]] std::size_t first_in_reach(std::uint32_t first_cluster,
                                             std::uint32_t /*radius*/) const override {
        return first_cluster == 0 ? 0 : 2;
    }
    [[nodiscard]] ReachBound most_in_reach(std::uint32_t /*radius*/) const override {
        return {.receivers = kPoints, .shown = "10 points", .remedy = "fewer points"};
    }
    [[nodiscard]] std::size_t middle_of_cluster(std::uint32_t cluster) const override {
        return kFirstOfCluster.at(cluster) + 2;
    }
    [[nodiscard]] std::vector<std::size_t> spread_over_all(
        std::size_t /*count*/) const override {
        return {0, 3, 6, 9};
    }
    // The last is no receiver's slot.
    [[nodiscard]] ClusterPatch patch() const override {
        return {.slots = {1, 3, 4}, .neighbours = {{0, 1}, {1, 2}}};
    }

    [[nodiscard]] float spacing() const { return spacing_; }
    // Of each receiver so far.
    [[nodiscard]] std::vector<int> looks() const { return {looks_.begin(), looks_.end()}; }

  private:
    [[nodiscard]] Receiver point(std::size_t receiver, std::uint32_t run) const {
        const Imath::V3f down{0, -1, 0};
        const Imath::V3f above =
            corner_ + Imath::V3f(spacing_ * static_cast<float>(receiver), 0, 0);
        const auto hit = caster_.closest_hit(above, down);
        ReceiverSurface surface;
        surface.point = scene::surface_point(caster_.scene(), hit->mesh, hit->triangle,
                                             hit->barycentric, down);
        surface.share = 1;
        surface.footprint = spacing_;
        surface.material = caster_.scene().meshes[hit->mesh].material;
        surface.origins.fill(offset_origin(surface.point));
        return {.index = receiver,
                .place = {.run = run, .along = 0.618 * run, .across = 0.414 * run},
                .surfaces = {surface}};
    }

    const RayCaster& caster_;
    Imath::V3f corner_;
    float spacing_ = 0;
    mutable std::array<std::atomic<int>, kPoints> looks_{};
};

BakeParameters parameters_of_points() {
    BakeParameters parameters;
    parameters.face_resolution = 8;
    parameters.bounces = 2;
    parameters.samples = 16;
    parameters.pool_radius = 2;
    parameters.shrinkage = 0;
    return parameters;
}

class ReceiversTest : public testing::Test {
  protected:
    using Response = std::array<double, 3>;

    ReceiversTest() {
        for (std::size_t texel = 0; texel < texels_.size(); ++texel) {
            light_.push_back(transport::unit_float(transport::mix_bits(texel)));
        }
        coefficients_.resize(rows_.projection().basis().coefficient_count());
        rows_.projection().project_radiance(light_, coefficients_);
    }

    [[nodiscard]] Response response_of(const CoefficientRow& row) const {
        Response response{};
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t j = 0; j < coefficients_.size(); ++j) {
                response[c] += double{row.rgb[c][j]} * coefficients_[j];
            }
        }
        return response;
    }

    [[nodiscard]] Response direct_response(const Receiver& receiver) const {
        TexelRow row;
        DirectLight::Scratch scratch;
        DirectLight(caster_, texels_, parameters_.edge_samples)
            .compute(receiver, parameters_.seed, row, scratch);
        double sum = 0;  // a floor without gloss is grey under its colour
        for (std::size_t texel = 0; texel < light_.size(); ++texel) {
            sum += double{row.plane[0][texel]} * light_[texel];
        }
        return {row.colour.x * sum, row.colour.y * sum, row.colour.z * sum};
    }

    // What the paths of one receiver bring in, over its reflectance.
    [[nodiscard]] Response path_response(const SurfacePaths& paths) const {
        Response sum{};
        auto key = paths.texels.begin();
        for (const Escapes& escapes : paths.escapes) {
            for (std::uint32_t i = 0; i < escapes.count; ++i, ++key) {
                const float radiance =
                    light_[texel_index_from_key(parameters_.face_resolution, *key)];
                for (std::size_t c = 0; c < 3; ++c) {
                    sum[c] +=
                        double{escapes.weight[static_cast<int>(c)]} * radiance / paths.paths;
                }
            }
        }
        return sum;
    }

    // By the definition: direct light, and the paths of the receivers along its edges and its
    // own, weighed by steps (a Gaussian of half the radius) and by distance over a tenth of the
    // harmonic mean distance to what is around.
    [[nodiscard]] Response expected_response(std::size_t receiver) const {
        const TracedReceiver own = tracer_.trace(receivers_.look(receiver));
        const ReceiverSurface& surface = own.receiver.surfaces.front();
        std::vector<std::size_t> sources = kEdges.at(receiver);
        sources.push_back(receiver);
        Response pooled{};
        double total = 0;
        for (const std::size_t source : sources) {
            const TracedReceiver other = tracer_.trace(receivers_.look(source));
            const double steps = source == receiver ? 0 : 1;
            const double distance =
                double{(other.receiver.surfaces.front().point.position - surface.point.position)
                           .length()};
            const double widths = distance * double{own.paths.front().nearness} / 0.1;
            const double weight = std::exp(-2 * steps / 4) * std::exp(-0.5 * widths * widths);
            const Response paths = path_response(other.paths.front());
            total += weight;
            for (std::size_t c = 0; c < 3; ++c) {
                pooled[c] += weight * paths[c];
            }
        }
        Response response = direct_response(own.receiver);
        for (std::size_t c = 0; c < 3; ++c) {
            response[c] += double{reflectance(surface.point.bsdf)[static_cast<int>(c)]} *
                           pooled[c] / total;
        }
        return response;
    }

    BakeParameters parameters_ = parameters_of_points();
    scene::Scene scene_ = scene::build_builtin_scene("box");
    RayCaster caster_{scene_};
    LightTexels texels_{parameters_.face_resolution, parameters_.seed};
    FloorPoints receivers_{caster_};
    PathTracer tracer_{caster_, parameters_};
    RowBaker rows_{caster_, texels_, parameters_};
    std::vector<float> light_;  // radiance of the texels, grey
    std::vector<float> coefficients_;
};

TEST_F(ReceiversTest, ARowIsDirectLightAndThePathsOfItsNeighbours) {
    TracedReceivers traced(receivers_, tracer_, parameters_);
    const PathPool pool(traced);
    RowBaker::Scratch scratch;
    std::vector<CoefficientRow> rows;
    double changed = 0;
    for (std::uint32_t block = 0; block < 2; ++block) {
        traced.move_to(block, 1);
        for (std::size_t i = kFirstOfCluster.at(block); i < kFirstOfCluster.at(block + 1);
             ++i) {
            rows_.bake(traced.at(i), &pool, rows, scratch);
            const Response found = response_of(rows.front());
            const Response expected = expected_response(i);
            rows_.bake(traced.at(i), nullptr, rows, scratch);
            const Response alone = response_of(rows.front());
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(found[c], expected[c], 1e-4 * expected[c]) << i;
                changed = std::max(changed, std::abs(alone[c] / expected[c] - 1));
            }
        }
    }
    EXPECT_GT(changed, 0.01);  // or neighbours would prove nothing
}

TEST_F(ReceiversTest, EachIsTracedOnceAndThoseThatLaterBlocksNeedAreKept) {
    TracedReceivers traced(receivers_, tracer_, parameters_);
    const std::uint64_t first = traced.move_to(0, 1);
    EXPECT_EQ(receivers_.looks(), (std::vector{1, 1, 1, 1, 1, 1, 1, 1, 0, 0}));
    EXPECT_GT(first, 0U);
    const std::uint64_t second = traced.move_to(1, 1);
    EXPECT_EQ(receivers_.looks(), (std::vector<int>(kPoints, 1)));
    EXPECT_EQ(traced.at(2).receiver.index, 2U);
    EXPECT_EQ(traced.at(9).receiver.index, 9U);
    EXPECT_EQ(traced.move_to(1, 1), 0U);
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
        all += tracer_.trace(receivers_.look(i)).paths.front().rays;
    }
    EXPECT_EQ(first + second, all);
}

TEST_F(ReceiversTest, BlocksHoldTheRowsOfTheirClustersInTheirSlots) {
    LightRows light_rows(caster_, receivers_, parameters_);
    const Quantisation quantisation =
        plan_quantisation(light_rows, parameters_.bits, parameters_.seed);
    light_rows.move_to(0, 2);
    TracedReceivers traced(receivers_, tracer_, parameters_);
    traced.move_to(0, 2);
    std::atomic<std::uint64_t> ticked = 0;
    const BakedShard shard =
        ShardBaker(light_rows, quantisation, 1)
            .bake(kBothClusters, [&](std::uint64_t receivers, std::uint64_t) {
                ticked += receivers;
                return true;
            });
    EXPECT_EQ(ticked, kPoints);
    ASSERT_EQ(shard.blocks.size(), 2U);
    const PathPool pool(traced);
    RowBaker::Scratch scratch;
    const std::uint32_t channels = quantisation.colour.channels;
    for (std::uint32_t block = 0; block < 2; ++block) {
        BlockRows rows(coefficients_.size(), channels);
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            const auto receiver = receivers_.receiver_at(block, slot);
            ChannelRow split;
            if (receiver) {
                std::vector<CoefficientRow> terms;
                rows_.bake(traced.at(*receiver), &pool, terms, scratch);
                split_colours(quantisation.colour, terms.front(), split);
                for (std::uint32_t k = 0; k < channels; ++k) {
                    rows.set(slot, k, split.channel[k]);
                }
            }
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at = (block * 3 + c) * transport::kBlockSize + slot;
                EXPECT_EQ(shard.notes.tint[at],
                          receiver ? split.tint[static_cast<int>(c)] : 0.0F);
            }
        }
        StoredRows none;
        const transport::EncodedBlock expected =
            encode_block(quantisation.block_basis, rows, quantisation.steps, none);
        const transport::EncodedBlock& found = shard.blocks[block];
        ASSERT_EQ(found.segment_count(), expected.segment_count());
        std::size_t occupied = 0;
        for (std::size_t i = 0; i < expected.segment_count(); ++i) {
            ASSERT_EQ(found.tag(i), expected.tag(i)) << i;
            ASSERT_TRUE(std::equal(found.cell(i).begin(), found.cell(i).end(),
                                   expected.cell(i).begin(), expected.cell(i).end()))
                << i;
            occupied += expected.tag(i) == transport::CellTag::empty ? 0U : 1U;
        }
        EXPECT_GT(occupied, 10U);
        EXPECT_GT(shard.notes.errors[block][kNatural].value, 0);
        EXPECT_LT(shard.notes.errors[block][kNatural].error,
                  1e-2 * shard.notes.errors[block][kNatural].value);
    }
}

TEST_F(ReceiversTest, TheStatedErrorOfSamplingFallsWithMorePaths) {
    parameters_.pool_radius = 0;
    const auto stated = [&] {
        LightRows rows(caster_, receivers_, parameters_);
        const Quantisation quantisation =
            plan_quantisation(rows, parameters_.bits, parameters_.seed);
        rows.move_to(0, 2);
        const BakedShard shard =
            ShardBaker(rows, quantisation, 1).bake(kBothClusters, [](auto...) { return true; });
        // Points are the same with another seed.
        return measure_sampling_error(caster_, receivers_, receivers_, parameters_,
                                      shard.notes.samples)
            .natural;
    };
    const double few = stated();
    parameters_.samples *= 64;
    const double many = stated();
    EXPECT_GT(few, 0);
    EXPECT_LT(many, few);
}

}  // namespace
}  // namespace relume::bake
