#include "precompute/bake/blocks/colour_split.h"

#include "protocol/transport/hash.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::bake {
namespace {

CoefficientRow random_row(const Imath::V3f& tint, float chroma) {
    CoefficientRow row;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::uint64_t j = 0; j < 96; ++j) {
            const float grey = transport::unit_float(transport::mix_bits(j)) - 0.5F;
            const float own = transport::unit_float(transport::mix_bits(j * 3 + c)) - 0.5F;
            row.rgb[c].push_back(tint[static_cast<int>(c)] * (grey + chroma * own));
        }
        row.rgb[c][0] += tint[static_cast<int>(c)];
    }
    row.white = tint;
    row.direct_white = tint;
    return row;
}

Imath::V3f value_of(const transport::ColourModel& model,
                    const ChannelRow& channels,
                    std::size_t j) {
    Imath::V3f value{0, 0, 0};
    for (int c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < model.channels; ++k) {
            value[c] += channels.tint[c] * model.matrix[static_cast<std::size_t>(c)][k] *
                        channels.channel[k][j];
        }
    }
    return value;
}

void expect_round_trip(const transport::ColourModel& model, const CoefficientRow& row) {
    ChannelRow channels;
    split_colours(model, row, channels);
    for (std::size_t j = 0; j < row.rgb[0].size(); ++j) {
        const Imath::V3f value = value_of(model, channels, j);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(value[c], row.rgb[static_cast<std::size_t>(c)][j], 1e-5F);
        }
    }
}

TEST(ColourSplit, ThreeChannelsHoldAnyColours) {
    expect_round_trip(luma_chroma_model(), random_row({0.9F, 0.5F, 0.1F}, 0.4F));
    expect_round_trip(luma_chroma_model(), random_row({0.9F, 0, 0.1F}, 0.4F));
    expect_round_trip(luma_chroma_model(), random_row({0, 0, 0}, 0.4F));
}

TEST(ColourSplit, OneChannelHoldsTintedGrey) {
    expect_round_trip(grey_model(), random_row({0.9F, 0.5F, 0.1F}, 0));
    expect_round_trip(grey_model(), random_row({0, 0.5F, 0}, 0));
}

TEST(ColourSplit, TintedGreyLeavesChromaEmpty) {
    ChannelRow channels;
    split_colours(luma_chroma_model(), random_row({0.9F, 0.5F, 0.1F}, 0), channels);
    for (std::size_t k = 1; k < 3; ++k) {
        for (const float value : channels.channel[k]) {
            EXPECT_NEAR(value, 0, 1e-6F);
        }
    }
    EXPECT_NEAR(channels.tint.x + channels.tint.y + channels.tint.z, 3, 1e-5F);
}

TEST(ColourSplit, TheResidualSaysWhatOneChannelLoses) {
    const ChromaResidual none = chroma_residual(random_row({0.9F, 0.5F, 0.1F}, 0));
    EXPECT_LT(none.residual, 1e-12 * none.energy);
    const ChromaResidual some = chroma_residual(random_row({0.5F, 0.5F, 0.5F}, 0.5F));
    EXPECT_GT(some.residual, 0.01 * some.energy);
}

TEST(ColourSplit, ColumnsOfTheMatrixAreOrthogonal) {
    const auto model = luma_chroma_model();
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            float dot = 0;
            for (const auto& row : model.matrix) {
                dot += row[a] * row[b];
            }
            EXPECT_EQ(dot, 0);
        }
    }
}

}  // namespace
}  // namespace relume::bake
