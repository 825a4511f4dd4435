// relume-lab terms: error against the number of terms of one light.
#include "protocol/base/files/atomic_file.h"
#include "tests/lab/charts/terms_chart.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/commands/scene_options.h"
#include "tests/lab/measures/record_table.h"
#include "tests/lab/measures/terms_sweep.h"

#include <filesystem>
#include <memory>

namespace relume::lab {
namespace {

struct TermsOptions {
    SceneOptions scene;
    std::vector<std::string> methods{"nwa-{}-none", "nwa-{}-area", "nwa-{}-transport"};
    std::string output = "out/terms";
};

int run(const TermsOptions& options) {
    Experiment experiment;
    experiment.scene = options.scene.scene();
    experiment.sequence = options.scene.lighting_sequence();
    experiment.environments =
        options.scene.environments(experiment.scene.haar->face_resolution());
    const std::vector<TermsCurve> curves = sweep_terms(experiment, options.methods);
    const std::filesystem::path output(options.output);
    std::filesystem::create_directories(output);
    std::vector<Record> records;
    for (const TermsCurve& curve : curves) {
        records.insert(records.end(), curve.records.begin(), curve.records.end());
    }
    const std::string csv = csv_from_records(records);
    files::write_file_atomically(output / "terms.csv", {files::bytes_of(csv)});
    draw_terms_chart(output / "terms", options.scene.title(), curves);
    return 0;
}

}  // namespace

Command add_terms_command(CLI::App& program) {
    auto options = std::make_shared<TermsOptions>();
    CLI::App* command = program.add_subcommand(
        "terms", "chart error against the number of terms of a sequence's first light");
    options->scene.add_to(*command);
    command
        ->add_option("--methods", options->methods,
                     "as of `run`, with {} where the number of terms goes")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("-o,--output", options->output, "folder for chart and CSV")
        ->capture_default_str();
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
