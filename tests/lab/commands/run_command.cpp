// relume-lab run: methods over one lighting sequence.
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/commands/progress.h"
#include "tests/lab/commands/scene_options.h"
#include "tests/lab/measures/experiment.h"
#include "tests/lab/measures/summary.h"
#include "tests/lab/report/run_report.h"

#include <fmt/format.h>

#include <memory>

namespace relume::lab {
namespace {

struct RunOptions {
    SceneOptions scene;
    std::vector<std::string> methods{"nwa-30", "nwa-60", "nwa-100",
                                     "bi-30",  "pbi-30", "pbi-30-transport"};
    std::string output = "out/lab";
    std::vector<std::uint32_t> pictures;
};

Experiment experiment_from(const RunOptions& options) {
    Experiment experiment;
    for (const std::string& text : options.methods) {
        experiment.methods.push_back(method_from_text(text));
    }
    experiment.sequence = options.scene.lighting_sequence();
    experiment.scene = options.scene.scene();
    experiment.environments =
        options.scene.environments(experiment.scene.haar->face_resolution());
    experiment.pictures = options.pictures;
    return experiment;
}

void print_summary(const std::vector<Summary>& summaries) {
    fmt::print("{:<26} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "method",
               "L2 moving", "H1 moving", "flicker", "dE*ab", "rest +5", "rest +25", "last",
               "kB/image", "us/image");
    for (const Summary& s : summaries) {
        fmt::print(
            "{:<26} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.2e} {:>9.2e} {:>9.2e} "
            "{:>9.0f} {:>8.0f}\n",
            s.method, s.l2, s.h1, s.flicker, s.delta_e, s.soon_l2, s.later_l2, s.last_l2,
            s.bytes / 1000, s.microseconds);
    }
}

int run(const RunOptions& options) {
    Experiment experiment = experiment_from(options);
    Findings findings;
    {
        Progress progress("image", experiment.sequence.images);
        experiment.go_on = [&progress](std::uint32_t done) {
            progress.update(done);
            return !is_interrupted();
        };
        catch_interruption();
        findings = run_experiment(experiment);
    }
    write_run_report(options.output, options.scene.title(), experiment, findings);
    print_summary(summaries(findings.records, experiment.sequence.rests_from()));
    if (!findings.complete) {
        fmt::print(stderr, "relume-lab: interrupted after {} of {} images; {} is partial\n",
                   findings.images_done, experiment.sequence.images, options.output);
        return kInterrupted;
    }
    return 0;
}

}  // namespace

Command add_run_command(CLI::App& program) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = program.add_subcommand("run", "run methods over one lighting sequence");
    options->scene.add_to(*command);
    command->add_option("--methods", options->methods, "separated by commas, as below")
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--pictures", options->pictures,
                     "images to show in the report, separated by commas")
        ->delimiter(',');
    command->add_option("-o,--output", options->output, "folder for what is found")
        ->capture_default_str();
    command->footer(
        "Methods:\n" + method_help() +
        "  BUDGET is a number of coefficients (30) or bytes (400kB), PRIORITY area, "
        "none, transport or benefit.\n");
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
