// relume-lab seeds: the claims of the papers that Relume starts from, tried on our data.
#include "tests/lab/claims/claim.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/commands/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace relume::lab {
namespace {

struct SeedsOptions {
    std::string transport;
    std::string sh_transport;
    std::string cache = default_scene_cache();
    bool json = false;
};

LabScene demo_scene(const SeedsOptions& options) {
    constexpr std::uint32_t kSide = 192;
    return {.haar = options.transport.empty()
                        ? LabScenes(options.cache).scene("table", kSide)
                        : std::make_shared<const served::Scene>(
                              transport::Transport::open(options.transport)),
            .sh_transport = options.sh_transport};
}

nlohmann::json json_from(const Claim& claim) {
    return {{"claim", claim.claim}, {"source", claim.source}, {"measure", claim.measure},
            {"found", claim.found}, {"beside", claim.beside}, {"holds", claim.holds},
            {"why", claim.why}};
}

std::string json_report(const std::vector<Claim>& claims) {
    nlohmann::json array = nlohmann::json::array();
    for (const Claim& claim : claims) {
        array.push_back(json_from(claim));
    }
    return nlohmann::json{{"claims", array}}.dump(2);
}

// As Markdown, so that it can stand in a README.
std::string table_report(const std::vector<Claim>& claims) {
    std::string table =
        "| claim | source | its measure | found | beside it | holds | why ours "
        "differ |\n|---|---|---|---|---|---|---|\n";
    for (const Claim& claim : claims) {
        table += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", claim.claim,
                             claim.source, claim.measure, claim.found, claim.beside,
                             claim.holds ? "yes" : "no", claim.why);
    }
    return table;
}

int run(const SeedsOptions& options) {
    catch_interruption();
    std::vector<Claim> claims;
    try {
        // A line for every experiment, drawn over while it runs.
        std::unique_ptr<Progress> progress;
        Evidence evidence(
            {.demo = demo_scene(options),
             .cache = options.cache,
             .go_on = [&](const std::string& what, std::uint32_t done, std::uint32_t of) {
                 if (done == 0) {
                     progress = std::make_unique<Progress>("step", of);
                 }
                 progress->update(done, what);
                 return !is_interrupted();
             }});
        for (const ClaimGroup& group : claim_groups()) {
            const std::vector<Claim> more = group(evidence);
            claims.insert(claims.end(), more.begin(), more.end());
        }
    } catch (const EvidenceInterrupted&) {
        fmt::print(stderr, "relume-lab: interrupted; the claims are those tried so far\n");
    }
    fmt::print("{}\n", options.json ? json_report(claims) : table_report(claims));
    return is_interrupted() ? kInterrupted : 0;
}

}  // namespace

Command add_seeds_command(CLI::App& program) {
    auto options = std::make_shared<SeedsOptions>();
    CLI::App* command =
        program.add_subcommand("seeds", "try the papers' claims on our data; minutes");
    command->add_option("--transport", options->transport,
                        "transport directory, instead of the built-in table, 192x192, 6x32x32");
    command->add_option("--sh-transport", options->sh_transport,
                        "the same view baked in spherical harmonics");
    command->add_option("--cache", options->cache, "where scenes are baked to and kept")
        ->capture_default_str();
    command->add_flag("--json", options->json, "one JSON object instead of a table");
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
