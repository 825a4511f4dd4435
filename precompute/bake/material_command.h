// `relume-bake material`: a material field as a file, and what people ask about one.
#pragma once

#include <CLI/App.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace relume::bake {

struct MaterialArguments {
    std::string name;
    std::string model;
    std::string output;
    std::uint32_t light_resolution = 64;
    double energy_fraction = 0.999;
    std::optional<std::uint32_t> normal_side;
    std::optional<std::uint32_t> reflection_side;
    std::uint32_t samples_per_side = 2;
    std::uint32_t most_mebibytes = 1024;
    std::uint32_t threads = 0;
};

void add_material_command(CLI::App& app, MaterialArguments& arguments);

// Says how much memory the field may take, bakes and writes it whole or not at all. Throws
// program::UsageError, BakeError, files::FileError and what reads measured BRDFs.
int run_material_command(const MaterialArguments& arguments);

// What a file of a material holds, for `info --json`; checks everything on the way. Throws
// tripling::MaterialFileError, files::FileError.
[[nodiscard]] nlohmann::json describe_material(const std::filesystem::path& file);
// The same for people, a few lines.
[[nodiscard]] std::string text_from_material(const nlohmann::json& description);

// Whether `info` and `verify` are asked about a file of a material.
[[nodiscard]] bool is_material_file(const std::filesystem::path& path);

}  // namespace relume::bake
