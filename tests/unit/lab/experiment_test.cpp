// Experiments on a small scene: what they say is the same on every run.
#include "tests/lab/measures/experiment.h"

#include "tests/lab/measures/record_table.h"
#include "tests/lab/measures/summary.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <limits>
#include <regex>

namespace relume::lab {
namespace {

class ExperimentTest : public testing::Test {
  protected:
    ExperimentTest() {
        experiment_.scene.haar = tiny_.scene();
        experiment_.environments.environment =
            load_environment("sky-sunset", tiny_.scene()->face_resolution());
        experiment_.sequence = load_sequence("quick-turn");
        experiment_.sequence.images = 12;
        for (const char* text : {"nwa-20", "bi-20", "pbi-20", "pbi-dealer-20",
                                 "pbi-exhaustive-20", "guarded-20"}) {
            experiment_.methods.push_back(method_from_text(text));
        }
    }

    // Without the last column, which is a time.
    [[nodiscard]] std::string reproducible_csv() const {
        const std::string csv = csv_from_records(run_experiment(experiment_).records);
        return std::regex_replace(csv, std::regex(",[^,\n]*\n"), "\n");
    }

    engine::TinyScene tiny_;
    Experiment experiment_;
};

TEST_F(ExperimentTest, IsTheSameOnEveryRunAndAnyNumberOfThreads) {
    const std::string once = reproducible_csv();
    EXPECT_NE(once.find("pbi-exhaustive-20-area,11,"), std::string::npos);
    EXPECT_EQ(once, reproducible_csv());
    std::string alone;
    tbb::task_arena(1).execute([&] { alone = reproducible_csv(); });
    EXPECT_EQ(once, alone);
}

TEST_F(ExperimentTest, MethodsDoNotDisturbEachOther) {
    const std::vector<Record> together = run_experiment(experiment_).records;
    for (const Method& method : std::vector<Method>(experiment_.methods)) {
        experiment_.methods = {method};
        const std::vector<Record> alone = run_experiment(experiment_).records;
        const std::vector<Record> own = records_of(together, method.label);
        ASSERT_EQ(own.size(), alone.size());
        for (std::size_t i = 0; i < own.size(); ++i) {
            EXPECT_EQ(own[i].error.l2, alone[i].error.l2) << method.label << " " << i;
        }
    }
}

TEST_F(ExperimentTest, WithAllCoefficientsEveryMethodIsExact) {
    experiment_.methods = {method_from_text("nwa-100000"), method_from_text("pbi-100000"),
                           method_from_text("pbi-dealer-100000")};
    for (const Record& record : run_experiment(experiment_).records) {
        EXPECT_LT(record.error.l2, 1e-5) << record.method << " " << record.image;
        EXPECT_LT(record.lighting_l1, 1e-5) << record.method << " " << record.image;
        for (const BandRecord& band : record.bands) {
            EXPECT_EQ(band.residual_energy, 0);
        }
    }
}

TEST_F(ExperimentTest, CountsWhatItAdds) {
    for (const Record& record : run_experiment(experiment_).records) {
        std::uint32_t updated = 0;
        for (const BandRecord& band : record.bands) {
            updated += band.updated;
        }
        EXPECT_EQ(updated, record.applied) << record.method << " " << record.image;
        EXPECT_GE(record.covered, updated);
        EXPECT_LE(record.covered, 20 * (record.image + 1));
    }
}

TEST_F(ExperimentTest, EndsWhenAskedTo) {
    experiment_.go_on = [](std::uint32_t done) { return done < 3; };
    const Findings findings = run_experiment(experiment_);
    EXPECT_FALSE(findings.complete);
    EXPECT_EQ(findings.images_done, 3U);
    EXPECT_EQ(findings.records.size(), 3 * experiment_.methods.size());
}

TEST_F(ExperimentTest, JsonHasEveryColumnAndNullForWhatIsNotThere) {
    std::vector<Record> records = run_experiment(experiment_).records;
    records[0].stated_error = std::numeric_limits<double>::quiet_NaN();
    const nlohmann::json json = nlohmann::json::parse(json_from_records(records).dump());
    for (const RecordColumn& column : record_columns()) {
        EXPECT_TRUE(json[1][std::string(column.name)].is_number()) << column.name;
    }
    EXPECT_TRUE(json[0]["stated"].is_null());
    EXPECT_EQ(csv_from_records(records).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace relume::lab
