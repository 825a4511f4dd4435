// relume-lab: speed against accuracy on any scene, light and sequence.
#include "protocol/base/program/program.h"
#include "tests/lab/commands/commands.h"

#include <vector>

int main(int argc, char** argv) {
    namespace lab = relume::lab;
    CLI::App app("Charts speed against accuracy of relighting methods.", "relume-lab");
    app.require_subcommand(1);
    const std::vector<lab::Command> commands{
        lab::add_run_command(app),          lab::add_pareto_command(app),
        lab::add_terms_command(app),        lab::add_seeds_command(app),
        lab::add_light_filter_command(app), lab::add_bake_noise_command(app),
        lab::add_geometry_command(app),     lab::add_brdf_terms_command(app),
        lab::add_view_terms_command(app),   lab::add_cpca_command(app),
        lab::add_curves_command(app),       lab::add_stability_command(app),
        lab::add_triple_command(app),       lab::add_triple_pareto_command(app)};
    return relume::program::run_program(app, argc, argv, [&] {
        for (const lab::Command& command : commands) {
            if (command.app->parsed()) {
                return command.run();
            }
        }
        return relume::program::kWrongUsage;  // one is required, and so parsed
    });
}
