// Options that say what is relit, and by which lights.
#pragma once

#include "tests/lab/methods/method.h"
#include "tests/lab/sequences/lighting_sequence.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace relume::lab {

struct SceneOptions {
    std::string transport;
    std::string sh_transport;
    std::string environment;
    std::string blend = "studio-softboxes";
    std::string sequence = "slow-fast-slow";
    std::optional<std::uint64_t> seed;  // none: the sequence's own

    void add_to(CLI::App& command);

    // Each throws what reading its file throws.
    [[nodiscard]] LabScene scene() const;
    [[nodiscard]] LightingSequence lighting_sequence() const;
    // `face_resolution` is the scene's.
    [[nodiscard]] Environments environments(std::uint32_t face_resolution) const;
    // "table, studio, slow-fast-slow".
    [[nodiscard]] std::string title() const;
};

}  // namespace relume::lab
