#include "tests/lab/commands/scene_options.h"

#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

namespace relume::lab {

void SceneOptions::add_to(CLI::App& command) {
    command.add_option("--transport", transport, "transport directory")->required();
    command.add_option("--sh-transport", sh_transport,
                       "the same view baked in spherical harmonics, for methods that need it");
    command
        .add_option("--environment", environment,
                    "HDR map: a file, one of blender-data's (studio), a procedural one "
                    "(sky-afternoon), or bare-sun")
        ->required();
    command.add_option("--blend", blend, "a second one, for sequences that blend into it")
        ->capture_default_str();
    command
        .add_option("--sequence", sequence,
                    fmt::format("what the light does: a file, or one of {}",
                                fmt::join(sequence_names(), ", ")))
        ->capture_default_str();
    command.add_option("--seed", seed, "of random sequences, instead of the sequence's own");
}

LabScene SceneOptions::scene() const {
    return {
        .haar = std::make_shared<const served::Scene>(transport::Transport::open(transport)),
        .sh_transport = sh_transport};
}

LightingSequence SceneOptions::lighting_sequence() const {
    LightingSequence loaded = load_sequence(sequence);
    loaded.seed = seed.value_or(loaded.seed);
    return loaded;
}

Environments SceneOptions::environments(std::uint32_t face_resolution) const {
    return {.environment = load_environment(environment, face_resolution),
            .blend = load_environment(blend, face_resolution)};
}

std::string SceneOptions::title() const {
    const auto stem = [](const std::string& path) {
        return std::filesystem::path(path).stem().string();
    };
    return fmt::format("{}, {}, {}", stem(transport), stem(environment), stem(sequence));
}

}  // namespace relume::lab
