// relume-lab brdf-terms: how many products a BRDF needs, beside what the literature says.
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/measures/brdf_terms.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

struct BrdfTermsOptions {
    std::vector<std::string> measured;
    bool json = false;
};

// What is said of the literature's glossy materials; [Overbeck06T] states 3 to 10 terms and no
// error.
struct StatedError {
    std::size_t terms;
    double error;
};
constexpr StatedError kStated[]{{5, 0.10}, {10, 0.02}};

nlohmann::json json_from(const BrdfTerms& row) {
    return {{"brdf", row.brdf},
            {"method", row.method},
            {"light", row.light},
            {"errors", row.errors},
            {"largest_negative_of_5", row.largest_negative_of_5},
            {"negative_norm_of_5", row.negative_norm_of_5},
            {"table", {{"rows", row.rows}, {"columns", row.columns}}}};
}

nlohmann::json stated_as_json() {
    nlohmann::json stated = nlohmann::json::array();
    for (const StatedError& of : kStated) {
        stated.push_back({{"terms", of.terms}, {"error", of.error}});
    }
    return stated;
}

// As Markdown, so that it can stand in a README.
void print_heading() {
    std::string heading = "| BRDF | method, light |";
    std::string rule = "|---|---|";
    for (std::size_t k = 1; k <= 10; ++k) {
        heading += fmt::format(" {} |", k);
        rule += "---|";
    }
    fmt::print("{} K for 10 % | lowest at 5 | negative at 5 |\n{}---|---|---|\n", heading,
               rule);
    std::string literature = "| the literature | |";
    for (std::size_t k = 1; k <= 10; ++k) {
        std::string cell;
        for (const StatedError& of : kStated) {
            cell += of.terms == k ? fmt::format("{:.0f} %", 100 * of.error) : "";
        }
        literature += fmt::format(" {} |", cell);
    }
    fmt::print("{} 5 | | |\n", literature);
}

void print_row(const BrdfTerms& row) {
    std::string line = fmt::format("| {} | {}, {} |", row.brdf, row.method, row.light);
    for (const double error : row.errors) {
        line += fmt::format(" {:.1f} % |", 100 * error);
    }
    const std::size_t needed = terms_for(row, kStated[0].error);
    line += needed == 0 ? " > 10 |" : fmt::format(" {} |", needed);
    line += fmt::format(" {:.2f} | {:.1f} % |", 0.0 - row.largest_negative_of_5,
                        100 * row.negative_norm_of_5);
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

int run(const BrdfTermsOptions& options) {
    catch_interruption();
    std::vector<LabBrdf> brdfs = lab_brdfs();
    for (const std::string& file : options.measured) {
        brdfs.push_back(measured_brdf(file));
    }
    nlohmann::json rows = nlohmann::json::array();
    if (!options.json) {
        print_heading();
    }
    for (const LabBrdf& brdf : brdfs) {
        if (is_interrupted()) {
            return kInterrupted;
        }
        for (const BrdfTerms& row : measure_brdf_terms(brdf)) {
            if (options.json) {
                rows.push_back(json_from(row));
            } else {
                print_row(row);
            }
        }
    }
    if (options.json) {
        fmt::print("{}\n",
                   nlohmann::json{{"literature", stated_as_json()}, {"brdfs", rows}}.dump(2));
    }
    return 0;
}

}  // namespace

Command add_brdf_terms_command(CLI::App& program) {
    auto options = std::make_shared<BrdfTermsOptions>();
    CLI::App* command = program.add_subcommand(
        "brdf-terms", "errors of BRDFs as sums of 1 to 10 products, by SVD and NMF");
    command->add_option("--measured", options->measured,
                        "further BRDFs, as .binary files of MERL's database");
    command->add_flag("--json", options->json, "JSON instead of a table");
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
