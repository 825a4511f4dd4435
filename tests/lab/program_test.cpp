// relume-lab as people run it.
#include "tests/support/program.h"

#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <thread>

namespace relume::lab {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::size_t line_count(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// Without the last column, microseconds: what does not depend on the clock.
std::string reproducible_part(const std::string& csv) {
    std::istringstream lines(csv);
    std::string part;
    for (std::string line; std::getline(lines, line);) {
        part += line.substr(0, line.rfind(',')) + '\n';
    }
    return part;
}

// The calling thread, and what it starts, on the first processor alone.
class OneProcessor {
  public:
    OneProcessor() {
        check(::sched_getaffinity(0, sizeof before_, &before_));
        cpu_set_t one;
        CPU_ZERO(&one);
        for (std::size_t cpu = 0; CPU_COUNT(&one) == 0; ++cpu) {
            if (CPU_ISSET(cpu, &before_)) {
                CPU_SET(cpu, &one);
            }
        }
        check(::sched_setaffinity(0, sizeof one, &one));
    }
    ~OneProcessor() { ::sched_setaffinity(0, sizeof before_, &before_); }
    OneProcessor(const OneProcessor&) = delete;
    OneProcessor& operator=(const OneProcessor&) = delete;
    OneProcessor(OneProcessor&&) = delete;
    OneProcessor& operator=(OneProcessor&&) = delete;

  private:
    static void check(int result) {
        if (result != 0) {
            throw std::system_error(errno, std::generic_category(), "affinity");
        }
    }

    cpu_set_t before_{};
};

class ProgramTest : public testing::Test {
  protected:
    // Turns the light by two degrees an image.
    [[nodiscard]] fs::path sequence_of(std::uint32_t images) const {
        const fs::path file = scratch_.path() / "turn.json";
        const nlohmann::json json{{"name", "turn"},
                                  {"description", "A turn."},
                                  {"images", images},
                                  {"seed", 1},
                                  {"yaw_degrees", {{"keys", {{0, 0}, {1000, 2000}}}}}};
        std::ofstream(file) << json;
        return file;
    }
    [[nodiscard]] test::Program run_of(
        std::uint32_t images, const std::string& methods = "nwa-30,pbi-30-transport") const {
        return {RELUME_LAB,
                {"run", "--transport", RELUME_TEST_SCENE, "--environment", "sky-afternoon",
                 "--sequence", sequence_of(images).string(), "--methods", methods, "--pictures",
                 "1", "-o", output().string()},
                scratch_.path(),
                "relume-lab"};
    }
    [[nodiscard]] fs::path output() const { return scratch_.path() / "out"; }
    [[nodiscard]] nlohmann::json run_json() const {
        return nlohmann::json::parse(content_of(output() / "run.json"));
    }

    test::ScratchDirectory scratch_;
};

TEST_F(ProgramTest, ARunLeavesAllThatItPromises) {
    constexpr std::uint32_t kImages = 4;
    test::Program run = run_of(kImages);
    ASSERT_EQ(run.wait(), 0) << run.errors();
    EXPECT_EQ(line_count(content_of(output() / "records.csv")), 1 + 2 * kImages);
    const nlohmann::json json = run_json();
    EXPECT_EQ(json["complete"], true);
    EXPECT_EQ(json["records"].size(), 2 * kImages);
    const std::string report = content_of(output() / "report.html");
    EXPECT_NE(report.find("</html>"), std::string::npos);
    EXPECT_NE(report.find("data:image/png;base64,"), std::string::npos);
    for (const char* chart : {"error", "flicker", "coverage", "bands", "energy"}) {
        const std::string name = chart;
        const std::string svg = content_of(output() / (name + ".svg"));
        EXPECT_NE(svg.find("<svg"), std::string::npos) << name;
        EXPECT_NE(svg.find("</svg>"), std::string::npos) << name;
        EXPECT_EQ(content_of(output() / (name + ".png")).substr(1, 3), "PNG") << name;
    }
    for (const auto& entry : fs::directory_iterator(output())) {
        EXPECT_NE(entry.path().extension(), ".part") << "left behind";
    }
}

// On a machine of one processor this only says that a run can be repeated.
TEST_F(ProgramTest, OneThreadFindsWhatManyDo) {
    const auto found = [&] {
        test::Program run =
            run_of(8, "nwa-30,bi-30,pbi-30-transport,pbi-dealer-30,guarded-90kB-benefit");
        EXPECT_EQ(run.wait(), 0) << run.errors();
        return reproducible_part(content_of(output() / "records.csv"));
    };
    const std::string with_many = found();
    const OneProcessor one;
    EXPECT_EQ(found(), with_many);
    EXPECT_EQ(line_count(with_many), 1 + 5 * 8);
}

TEST_F(ProgramTest, AnInterruptedRunWritesWhatItHasAndSaysSo) {
    test::Program run = run_of(100000);
    while (run.is_running() && run.errors().find("image 1 of") == std::string::npos) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ASSERT_TRUE(run.is_running()) << run.errors();
    run.send(SIGINT);
    EXPECT_EQ(run.wait(), 130) << run.errors();
    const nlohmann::json json = run_json();
    EXPECT_EQ(json["complete"], false);
    EXPECT_EQ(json["records"].size(), 2 * json["images_done"].get<std::size_t>());
    EXPECT_NE(content_of(output() / "report.html").find("interrupted"), std::string::npos);
    EXPECT_NE(run.errors().find("partial"), std::string::npos);
}

TEST_F(ProgramTest, BakeNoiseLeavesFiguresAndPicturesAndKeepsItsReference) {
    const auto run_with = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> words{"bake-noise",
                                       "--scenes",
                                       "box",
                                       "--environments",
                                       "sky-noon",
                                       "--width",
                                       "16",
                                       "--height",
                                       "16",
                                       "--light-resolution",
                                       "8",
                                       "--reference-side",
                                       "2",
                                       "--reference-paths",
                                       "16",
                                       "--seeds",
                                       "1",
                                       "--samples",
                                       "4",
                                       "--cache",
                                       scratch_.path() / "cache",
                                       "-o",
                                       scratch_.path() / folder};
        words.insert(words.end(), more.begin(), more.end());
        test::Program run(RELUME_LAB, words, scratch_.path(), "relume-lab");
        EXPECT_EQ(run.wait(), 0) << run.errors();
        return run.errors();
    };
    EXPECT_NE(run_with("first", {}).find("reference of box"), std::string::npos);
    EXPECT_EQ(run_with("second", {"--before", scratch_.path() / "first", "--crop", "0,0,8,4"})
                  .find("reference of"),
              std::string::npos);
    const auto json =
        nlohmann::json::parse(content_of(scratch_.path() / "second" / "bake-noise.json"));
    const nlohmann::json& box = json["scenes"]["box"];
    EXPECT_GT(box["lights"]["sky-noon"]["edge"]["relative_rmse"], 0);
    EXPECT_GT(box["visibility_rays"], 0);
    EXPECT_GT(box["path_rays"], 0);
    for (const char* folder : {"first", "second"}) {
        EXPECT_EQ(content_of(scratch_.path() / folder / "box-sky-noon.png").substr(1, 3),
                  "PNG");
    }
}

TEST_F(ProgramTest, GeometryMeasuresASurfaceUnderAMovingCamera) {
    const nlohmann::json found = nlohmann::json::parse(test::run_to_end(
        RELUME_LAB,
        {"geometry", "--scene", "box", "--vertices", "600", "--terms", "1", "--side", "48",
         "--images", "6", "--points", "60", "--cpca-light-resolution", "4", "--cache",
         scratch_.path() / "cache", "--json"},
        scratch_.path(), "relume-lab"));
    EXPECT_LE(found.at("configuration").at("vertices").get<int>(), 600);
    const nlohmann::json& figures = found.at("figures");
    for (const char* key :
         {"images_per_s_light_and_view", "images_per_s_view_only", "bytes", "bake_seconds"}) {
        EXPECT_GT(figures.at(key).get<double>(), 0) << key;
    }
    EXPECT_LT(figures.at("interpolation_error").get<double>(), 0.2);
    EXPECT_LT(figures.at("error_5_images_after_rest").get<double>(), 0.02);
    EXPECT_LE(figures.at("cpca_added_error").get<double>(), 0.011);
    for (const char* key : {"cpca_bytes_over_plain", "cpca_step2_gain", "seam_ratio"}) {
        EXPECT_GT(figures.at(key).get<double>(), 0) << key;
    }
}

TEST_F(ProgramTest, TripleComparesWaysToIntegrate) {
    const nlohmann::json found = nlohmann::json::parse(test::run_to_end(
        RELUME_LAB, {"triple",     "--scene",         "box",     "--environment",
                     "sky-noon",   "--vertices",      "1500",    "-n",
                     "8",          "--side",          "24",      "--material",
                     "lambert",    "--peer-vertices", "20",      "--images",
                     "2",          "--keep",          "--cache", scratch_.path() / "cache",
                     "--pictures", output().string(), "--json"},
        scratch_.path(), "relume-lab"));
    EXPECT_GT(found.at("visibility").at("seen_vertices").get<int>(), 0);
    EXPECT_GT(found.at("visibility").at("bytes_per_vertex").get<double>(), 0);
    const nlohmann::json& material = found.at("materials").at(0);
    for (const char* key : {"seconds_per_image", "ratio_to_bits", "ratio_to_decompressed",
                            "ratio_to_published", "ratio_to_pixels"}) {
        EXPECT_GT(material.at(key).get<double>(), 0) << key;
    }
    EXPECT_LT(material.at("error_bits").get<double>(), 1e-3);
    // With the most terms the sublinear algorithm errs less than with the fewest.
    EXPECT_LT(material.at("grid").back().at("error").get<double>(),
              material.at("grid").front().at("error").get<double>());
    // All of them: as far as single precision goes.
    EXPECT_LT(material.at("terms").back().at("error").get<double>(), 0.2);
    EXPECT_GT(material.at("moving").at("images_per_s_light_and_view").get<double>(), 0);
    // What is kept is the product, whichever two factors it is of.
    const nlohmann::json& kept = material.at("kept");
    EXPECT_LT(kept.at("product_texels").at("error").get<double>(), 1e-5);
    EXPECT_LT(kept.at("lit_texels").at("error").get<double>(), 1e-5);
    EXPECT_LT(kept.at("product_columns").at("error").get<double>(), 0.02);
    EXPECT_LE(kept.at("followed").back().at("error").get<double>(),
              kept.at("followed").front().at("error").get<double>());
    EXPECT_EQ(content_of(output() / "triple-lambert.png").substr(1, 3), "PNG");
    EXPECT_NE(content_of(output() / "triple-terms.svg").find("</svg>"), std::string::npos);
}

TEST_F(ProgramTest, TripleParetoComparesWhatMovesAlong) {
    const nlohmann::json found = nlohmann::json::parse(
        test::run_to_end(RELUME_LAB,
                         {"triple-pareto", "--vertices", "400", "-n", "8", "--side", "32",
                          "--images", "2", "--environment", "sky-noon", "--cache",
                          scratch_.path() / "cache", "--json", "-o", output().string()},
                         scratch_.path(), "relume-lab"));
    ASSERT_EQ(found.at("moving").size(), 3U);
    for (const auto& [moving, points] : found.at("moving").items()) {
        double bits = 1;
        double least = 1;
        for (const nlohmann::json& point : points) {
            const double error = point.at("error").get<double>();
            EXPECT_GT(point.at("milliseconds").get<double>(), 0) << point.dump();
            least = std::min(least, error);
            bits = point.at("series") == "triple, bits" ? error : bits;
        }
        // What sums over all open texels leaves off nothing but what its table does.
        EXPECT_LT(bits, 0.1) << moving;
        EXPECT_EQ(bits, least) << moving;
    }
    EXPECT_NE(content_of(output() / "triple-pareto.svg").find("</svg>"), std::string::npos);
}

TEST_F(ProgramTest, ViewTermsLeavesAChartAndErrorsOfEveryNumberOfTerms) {
    const nlohmann::json found = nlohmann::json::parse(test::run_to_end(
        RELUME_LAB,
        {"view-terms", "--scenes", "box", "--lights", "sky-noon", "--views", "2", "--side", "8",
         "--light-resolution", "8", "--terms", "3", "--json", "-o", output().string()},
        scratch_.path(), "relume-lab"));
    const nlohmann::json& errors = found.at("box").at("sky-noon").at("errors");
    ASSERT_EQ(errors.size(), 3U);
    EXPECT_LT(errors[0].get<double>(), 1e-4);  // all of it is diffuse
    EXPECT_NE(content_of(output() / "view-terms.svg").find("</svg>"), std::string::npos);
}

TEST_F(ProgramTest, AMistakeEndsInWords) {
    test::Program run(RELUME_LAB,
                      {"run", "--transport", "/nowhere.relume", "--environment", "sky-noon"},
                      scratch_.path(), "relume-lab");
    EXPECT_EQ(run.wait(), 1);
    EXPECT_NE(run.errors().find("/nowhere.relume"), std::string::npos);
}

}  // namespace
}  // namespace relume::lab
