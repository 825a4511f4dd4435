#include "precompute/bake/material_command.h"

#include "precompute/bake/base/error.h"
#include "precompute/materials/field_baker.h"
#include "precompute/materials/model_words.h"
#include "protocol/base/files/disk_room.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/names.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/basis/cubemap.h"
#include "protocol/tripling/material_file.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <stdexcept>

namespace relume::bake {
namespace {

constexpr const char* kSuffix = ".material";
constexpr double kMebibyte = 1 << 20;

std::filesystem::path output_of(const MaterialArguments& arguments) {
    if (!text::is_name(arguments.name)) {
        throw program::UsageError(fmt::format("the material's name is '{}', expected {}",
                                              arguments.name, text::kNameRule));
    }
    if (arguments.output.empty()) {
        return arguments.name + kSuffix;
    }
    if (!arguments.output.ends_with(kSuffix)) {
        throw program::UsageError(fmt::format("-o {}: found another ending, expected NAME{}",
                                              arguments.output, kSuffix));
    }
    return arguments.output;
}

materials::FieldParameters parameters_of(const MaterialArguments& arguments,
                                         const materials::FieldModel& model) {
    materials::FieldParameters parameters =
        materials::usual_parameters(model, arguments.light_resolution);
    parameters.energy_fraction = arguments.energy_fraction;
    parameters.samples_per_side = arguments.samples_per_side;
    parameters.most_bytes = std::size_t{arguments.most_mebibytes} << 20U;
    parameters.normal_side = arguments.normal_side.value_or(parameters.normal_side);
    parameters.reflection_side = arguments.reflection_side.value_or(parameters.reflection_side);
    return parameters;
}

void bake_material(const MaterialArguments& arguments, const std::filesystem::path& output) {
    materials::FieldModel model = materials::model_from_words(arguments.model);
    model.name = arguments.name;
    const materials::FieldParameters parameters = parameters_of(arguments, model);
    const materials::FieldSize size = materials::field_size(model, parameters);
    std::fprintf(stderr,
                 "relume-bake: %zu entries of 6x%ux%u, about %.1f MiB of memory, never more "
                 "than %.1f MiB\n",
                 size.entries, parameters.face_resolution, parameters.face_resolution,
                 static_cast<double>(size.expected_bytes) / kMebibyte,
                 static_cast<double>(size.bound_bytes) / kMebibyte);
    if (size.expected_bytes > parameters.most_bytes) {
        throw BakeError(fmt::format(
            "{}: the material would take about {:.0f} MiB, expected at most the {} MiB of "
            "--most-mib; fewer directions (--normals, --reflections) or less --energy take "
            "less",
            arguments.name, static_cast<double>(size.expected_bytes) / kMebibyte,
            arguments.most_mebibytes));
    }
    const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
    files::require_replaceable(output);
    files::require_room(folder, size.expected_bytes, size.expected_bytes);
    const timing::Stopwatch watch;
    materials::FieldReport report;
    const tripling::MaterialField field = materials::bake_field(model, parameters, report);
    tripling::write_material_file(output, field);
    fmt::print(
        "{}{:.3f} % of the coefficients hold at least {:.5f} of the energy of every "
        "entry; {:.1f} s\n",
        text_from_material(describe_material(output)), 100 * report.sparsity,
        report.least_energy, watch.seconds());
}

}  // namespace

void add_material_command(CLI::App& app, MaterialArguments& arguments) {
    auto* material = app.add_subcommand(
        "material", "Bake a material field: a material for all normals and views, as a file");
    material->add_option("name", arguments.name, "By which rooms call it")->required();
    material
        ->add_option("--model", arguments.model,
                     "lambert, phong:exponent=64, ggx:roughness=0.3,base=r/g/b,metallic=0, or "
                     "measured:FILE, a .binary file of the MERL database")
        ->required();
    material->add_option("-o,--output", arguments.output, "File to write [NAME.material]");
    material
        ->add_option("-n,--light-resolution", arguments.light_resolution,
                     "Texels along a face of the cubemap, 4 to 256")
        ->capture_default_str();
    material
        ->add_option("--energy", arguments.energy_fraction,
                     "Of the squares of every entry that is kept at least, above 0 to 1")
        ->capture_default_str();
    material->add_option("--normals", arguments.normal_side,
                         "Normals along a face of their cubemap, 1 to 65 [by model]");
    material->add_option("--reflections", arguments.reflection_side,
                         "Mirrored directions to the viewer, likewise [by width of highlight]");
    material
        ->add_option("--texel-samples", arguments.samples_per_side,
                     "Directions along a side of a texel, 1 to 8")
        ->capture_default_str();
    material
        ->add_option("--most-mib", arguments.most_mebibytes,
                     "Memory that the field may take, in MiB, 1 to 16384")
        ->check(CLI::Range(1, 16384))
        ->capture_default_str();
    material->add_option("--threads", arguments.threads, "Threads; 0: one per core")
        ->capture_default_str();
}

int run_material_command(const MaterialArguments& arguments) {
    const std::filesystem::path output = output_of(arguments);
    tbb::task_arena arena(arguments.threads == 0 ? tbb::info::default_concurrency()
                                                 : static_cast<int>(arguments.threads));
    try {
        arena.execute([&] { bake_material(arguments, output); });
    } catch (const std::invalid_argument& fault) {
        throw program::UsageError(fault.what());
    } catch (const std::length_error& fault) {
        throw BakeError(
            fmt::format("{}: {}, as --most-mib says", arguments.name, fault.what()));
    }
    return 0;
}

nlohmann::json describe_material(const std::filesystem::path& file) {
    const tripling::MaterialField field = tripling::read_material_file(file);
    std::uint64_t squares = 0;
    for (const tripling::WaveletStore& lobe : field.lobes) {
        for (std::size_t entry = 0; entry < lobe.size(); ++entry) {
            squares += lobe.view(entry).first.back();
        }
    }
    nlohmann::json colours = nlohmann::json::array();
    for (const Imath::V3f& colour : field.colours) {
        colours.push_back({colour.x, colour.y, colour.z});
    }
    return {{"format", "relume-material"},
            {"file", file.string()},
            {"name", field.name},
            {"face_resolution", field.face_resolution()},
            {"normal_side", field.normals.side()},
            {"reflection_side", field.reflections.side()},
            {"entries", field.entry_count()},
            {"lobes", field.lobes.size()},
            {"colours", std::move(colours)},
            {"energy_fraction", field.energy_fraction},
            {"squares", squares},
            {"bytes", std::filesystem::file_size(file)},
            {"memory_bytes", field.byte_count()}};
}

std::string text_from_material(const nlohmann::json& d) {
    const auto grid = [](int side) {
        return side == 1 ? std::string("one") : fmt::format("6×{0}×{0}", side);
    };
    const auto entries = d.at("entries").get<double>() * d.at("lobes").get<double>();
    return fmt::format(
        "{}\n  material {}: {} normal(s), {} reflection(s), {} lobe(s), 6×{n}×{n} lights, "
        "Haar\n"
        "  {:.1f} MB, in memory {:.1f} MB; {:.1f} squares of wavelets an entry, {:g} of its "
        "energy\n",
        d.at("file").get<std::string>(), d.at("name").get<std::string>(),
        grid(d.at("normal_side").get<int>()), grid(d.at("reflection_side").get<int>()),
        d.at("lobes").get<int>(), d.at("bytes").get<double>() / 1e6,
        d.at("memory_bytes").get<double>() / 1e6, d.at("squares").get<double>() / entries,
        d.at("energy_fraction").get<double>(),
        fmt::arg("n", d.at("face_resolution").get<int>()));
}

bool is_material_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) &&
           tripling::begins_as_material(files::read_beginning(path, 8));
}

}  // namespace relume::bake
