#include "client/cli/sequence_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace relume::cli {
namespace {

SequenceReport two_images() {
    SequenceReport report{
        .scene = "table", .room = "r", .rate_hz = 30, .seconds = 2, .edits = 3, .images = {}};
    ImageRecord moving{.time_s = 0.5,
                       .step = 0,
                       .header = {.width = 4,
                                  .height = 4,
                                  .revision = 3,
                                  .sequence = 1,
                                  .relative_error = 0.25F,
                                  .relight_ms = 2,
                                  .coefficients_applied = 30,
                                  .payload_bytes = 100,
                                  .coefficients_remaining = 50},
                       .edit_to_image_ms = {12, 8},
                       .file = "image_00000.jpg"};
    ImageRecord settled{.time_s = 1.5,
                        .step = 1,
                        .header = {.encoding = wire::ImageEncoding::half_planes,
                                   .width = 4,
                                   .height = 4,
                                   .revision = 4,
                                   .sequence = 2,
                                   .exact = true,
                                   .relight_ms = 4,
                                   .coefficients_applied = 50,
                                   .payload_bytes = 1000},
                        .edit_to_image_ms = {30},
                        .file = ""};
    report.images = {moving, settled};
    return report;
}

TEST(SequenceReports, SummaryAddsUp) {
    const nlohmann::json summary = summary_from_report(two_images());
    EXPECT_EQ(summary.at("images"), 2);
    EXPECT_EQ(summary.at("edits"), 3);
    EXPECT_EQ(summary.at("edits_shown"), 3);
    EXPECT_EQ(summary.at("bytes"), 1100);
    EXPECT_EQ(summary.at("coefficients_applied"), 80);
    EXPECT_EQ(summary.at("exact"), true);
    EXPECT_EQ(summary.at("relative_error"), 0);
    EXPECT_EQ(summary.at("edit_to_image_ms_p50"), 12);
    EXPECT_EQ(summary.at("edit_to_image_ms_p99"), 30);
    EXPECT_EQ(summary.at("images_per_second"), 1);
}

TEST(SequenceReports, NothingReceivedIsNotExact) {
    SequenceReport report;
    const nlohmann::json summary = summary_from_report(report);
    EXPECT_EQ(summary.at("exact"), false);
    EXPECT_TRUE(summary.at("relative_error").is_null());
    EXPECT_TRUE(summary.at("images_per_second").is_null());
    EXPECT_TRUE(summary.at("edit_to_image_ms_p50").is_null());
}

TEST(SequenceReports, CsvHasOneLineAnImageAndAsManyFieldsAsTheHeader) {
    std::istringstream csv(csv_from_report(two_images()));
    std::vector<std::string> lines;
    for (std::string line; std::getline(csv, line);) {
        lines.push_back(line);
    }
    ASSERT_EQ(lines.size(), 3U);
    const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
    EXPECT_EQ(std::count(lines[1].begin(), lines[1].end(), ','), commas);
    EXPECT_EQ(std::count(lines[2].begin(), lines[2].end(), ','), commas);
    EXPECT_EQ(
        lines[1],
        "0,0.500000,0,1,3,jpeg,0.25,0,12.000,0.000,2.000,0.000,30,50,100,image_00000.jpg");
    EXPECT_EQ(lines[2], "1,1.500000,1,2,4,half_planes,0,1,30.000,0.000,4.000,0.000,50,0,1000,");
}

TEST(SequenceReports, JsonHoldsEveryImageAndTheSummary) {
    const nlohmann::json object = json_from_report(two_images());
    EXPECT_EQ(object.at("images").size(), 2U);
    EXPECT_EQ(object.at("images")[0].at("edit_to_image_ms"), nlohmann::json({12, 8}));
    EXPECT_EQ(object.at("summary"), summary_from_report(two_images()));
}

}  // namespace
}  // namespace relume::cli
