// The subcommands of relume-lab, a file each.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace relume::lab {

// What runs, and how the program then ends: its exit code.
struct Command {
    CLI::App* app;
    std::function<int()> run;
};

// Each adds its subcommand with its options to the program.
[[nodiscard]] Command add_run_command(CLI::App& program);
[[nodiscard]] Command add_pareto_command(CLI::App& program);
[[nodiscard]] Command add_terms_command(CLI::App& program);
[[nodiscard]] Command add_seeds_command(CLI::App& program);
[[nodiscard]] Command add_light_filter_command(CLI::App& program);
[[nodiscard]] Command add_bake_noise_command(CLI::App& program);
[[nodiscard]] Command add_curves_command(CLI::App& program);
[[nodiscard]] Command add_geometry_command(CLI::App& program);
[[nodiscard]] Command add_brdf_terms_command(CLI::App& program);
[[nodiscard]] Command add_view_terms_command(CLI::App& program);
[[nodiscard]] Command add_cpca_command(CLI::App& program);
[[nodiscard]] Command add_stability_command(CLI::App& program);
[[nodiscard]] Command add_triple_command(CLI::App& program);
[[nodiscard]] Command add_triple_pareto_command(CLI::App& program);

}  // namespace relume::lab
