#include "protocol/transport/error.h"
#include "protocol/transport/transport.h"
#include "protocol/transport/transport_writer.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace relume::transport {
namespace {

std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

double squared_norm(const Sketch& sketch, std::size_t column, std::uint32_t colour) {
    double sum = 0;
    for (const std::int16_t value : sketch.values(column, colour)) {
        const double scaled = double{sketch.scale(column, colour)} * value;
        sum += scaled * scaled;
    }
    return sum;
}

class Directory : public testing::TestWithParam<std::uint32_t> {
  protected:
    test::ScratchDirectory scratch_;
    std::filesystem::path path_ = scratch_.path() / "tiny.relume";
    test::TinyTransportOptions options_{.channels = GetParam()};
};

TEST_P(Directory, OpensWhatWasWritten) {
    test::write_tiny_transport(path_, options_);
    const auto transport = Transport::open(path_);
    EXPECT_EQ(transport->manifest().image().width, options_.width);
    EXPECT_EQ(transport->channel_count(), options_.channels);
    EXPECT_EQ(transport->shards().size(), 2U);
    EXPECT_EQ(transport->manifest().measured.at("note"), "random");
    EXPECT_GT(transport->manifest().measured.at("cells").at("split3_dense8").at("cells"), 0);
}

// A manifest that names another order than the shards were written with.
TEST_P(Directory, RefusesABasisOfAnotherSize) {
    options_.signal_basis = basis::CubemapBasis::spherical_harmonics(5, 8);
    test::write_tiny_transport(path_, options_);
    EXPECT_EQ(Transport::open(path_)->column_count(), 25U);
    const std::filesystem::path file = path_ / "manifest.json";
    for (const basis::CubemapBasis& basis :
         {basis::CubemapBasis::spherical_harmonics(4, 8),
          basis::CubemapBasis::spherical_harmonics(6, 8), basis::CubemapBasis::haar(8)}) {
        Manifest manifest = manifest_from_text(contents(file), "m");
        manifest.signal_basis = basis;
        std::ofstream(file, std::ios::binary) << text_from_manifest(manifest);
        EXPECT_THROW((void)Transport::open(path_), TransportError);
    }
}

TEST_P(Directory, TwoBakesOfOneInputGiveIdenticalBytes) {
    const std::filesystem::path other = scratch_.path() / "other.relume";
    test::write_tiny_transport(path_, options_);
    test::write_tiny_transport(other, options_);
    for (const char* file : {"manifest.json", "columns.bin", "receivers.bin", "sketch.bin",
                             "shards/00000.shard", "shards/00001.shard"}) {
        EXPECT_EQ(contents(path_ / file), contents(other / file)) << file;
    }
}

TEST_P(Directory, EnergiesAndSketchesAreThoseOfTheStoredColumns) {
    test::write_tiny_transport(path_, options_);
    const auto transport = Transport::open(path_);
    const std::size_t columns = transport->column_count();
    const auto tint = transport->tint();
    for (std::size_t j = 0; j < columns; j += 17) {
        for (std::uint32_t c = 0; c < kColours; ++c) {
            std::vector<float> lighting(kColours * columns);
            lighting[c * columns + j] = 1;
            auto sums = test::dense_product(*transport, lighting);
            test::receivers_from_sums(sums);
            double energy = 0;
            for (std::size_t i = 0; i < sums.size(); ++i) {
                energy += sums[i] * sums[i] * double{tint[i]} * double{tint[i]};
            }
            EXPECT_NEAR(transport->energy(j, c), energy, 1e-5 * energy);
            // Relative standard deviation of one column's estimate is √(2/rows).
            for (const Sketch* sketch :
                 {&transport->stating_sketch(), &transport->choosing_sketch()}) {
                EXPECT_NEAR(squared_norm(*sketch, j, c), energy,
                            6 * std::sqrt(2.0 / sketch->rows()) * energy);
            }
        }
    }
}

// What is chosen by one sketch says nothing about the noise of the other: over many columns
// their deviations from the true energy are uncorrelated.
TEST_P(Directory, TheTwoSketchesAreIndependent) {
    test::write_tiny_transport(path_, options_);
    const auto transport = Transport::open(path_);
    double products = 0;
    double stating_squares = 0;
    double choosing_squares = 0;
    double count = 0;
    for (std::size_t j = 0; j < transport->column_count(); ++j) {
        const double energy = transport->energy(j, 0);
        if (energy > 0) {
            const double stating = squared_norm(transport->stating_sketch(), j, 0) / energy - 1;
            const double choosing =
                squared_norm(transport->choosing_sketch(), j, 0) / energy - 1;
            products += stating * choosing;
            stating_squares += stating * stating;
            choosing_squares += choosing * choosing;
            count += 1;
        }
    }
    EXPECT_GT(count, 100);
    EXPECT_LT(std::abs(products) / std::sqrt(stating_squares * choosing_squares),
              5 / std::sqrt(count));
}

TEST_P(Directory, AWriterKnowsItsOwnShardsOnly) {
    test::write_tiny_transport(path_, options_);
    Manifest manifest = Transport::open(path_)->manifest();
    const ShardPlan plan = ShardPlan::equal(manifest.block_count(), 3);
    EXPECT_TRUE(TransportWriter(path_, manifest, plan).has_shard(1));
    EXPECT_FALSE(std::filesystem::exists(path_ / "manifest.json"))
        << "a directory being written must not pass for a whole one";
    manifest.fingerprint += 1;
    EXPECT_FALSE(TransportWriter(path_, manifest, plan).has_shard(1));
    manifest.fingerprint -= 1;
    std::filesystem::resize_file(path_ / "shards/00001.shard", 1000);
    EXPECT_FALSE(TransportWriter(path_, manifest, plan).has_shard(1));
    EXPECT_THROW(TransportWriter(path_, manifest, plan).finish({}, {}), TransportError);
}

INSTANTIATE_TEST_SUITE_P(Channels, Directory, testing::Values(1U, 3U));

}  // namespace
}  // namespace relume::transport
