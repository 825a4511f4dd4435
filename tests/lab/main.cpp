// relume-lab: speed against accuracy on any scene, light and sequence.
#include "tests/lab/commands/commands.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <vector>

int main(int argc, char** argv) {
    namespace lab = relume::lab;
    CLI::App app("Charts speed against accuracy of relighting methods.", "relume-lab");
    app.require_subcommand(1);
    const std::vector<lab::Command> commands{
        lab::add_run_command(app), lab::add_pareto_command(app), lab::add_terms_command(app),
        lab::add_seeds_command(app), lab::add_stability_command(app)};
    CLI11_PARSE(app, argc, argv);
    try {
        for (const lab::Command& command : commands) {
            if (command.app->parsed()) {
                return command.run();
            }
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "relume-lab: {}\n", error.what());
    }
    return 1;
}
