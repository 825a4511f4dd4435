#include "precompute/bake/inspect.h"

#include "protocol/transport/error.h"
#include "protocol/transport/transport.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace relume::bake {
namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// report.json, or null: it is there for people and may be gone.
nlohmann::json report_of(const std::filesystem::path& directory) {
    return nlohmann::json::parse(text_of(directory / "report.json"), nullptr, false);
}

template <typename Check>
void collect(std::vector<std::string>& faults, Check check) {
    try {
        check();
    } catch (const transport::TransportError& error) {
        faults.emplace_back(error.what());
    }
}

std::string basis_text(const nlohmann::json& basis) {
    return basis.contains("order")
               ? fmt::format("spherical harmonics of order {}", basis.at("order").get<int>())
               : "Haar";
}

std::string megabytes(double bytes) {
    return fmt::format("{:.1f} MB", bytes / 1e6);
}

}  // namespace

nlohmann::json describe(const std::filesystem::path& directory) {
    const auto transport = transport::Transport::open(directory);
    const transport::Manifest& manifest = transport->manifest();
    nlohmann::json description{
        {"directory", directory.string()},
        {"generator", manifest.generator},
        {"image", {{"width", manifest.image.width}, {"height", manifest.image.height}}},
        {"basis", transport::json_from(manifest.light_basis)},
        {"columns", transport->column_count()},
        {"colour",
         {{"channels", manifest.colour.channels}, {"matrix", manifest.colour.matrix}}},
        {"shards", manifest.shards.size()},
        {"bytes", transport->total_bytes()},
        {"bake", manifest.bake},
        {"measured", manifest.measured}};
    std::uint64_t nonzeros = 0;
    for (const auto& encoding : manifest.measured.value("cells", nlohmann::json::object())) {
        nonzeros += encoding.value("nonzeros", std::uint64_t{0});
    }
    description["nonzeros"] = nonzeros;
    const nlohmann::json report = report_of(directory);
    description["report"] = report.is_discarded() ? nlohmann::json() : report;
    return description;
}

std::string text_from_description(const nlohmann::json& d) {
    const auto& image = d.at("image");
    const auto bytes = d.at("bytes").get<double>();
    const double pixels = image.at("width").get<double>() * image.at("height").get<double>();
    std::string text = fmt::format(
        "{}\n  {}×{} pixels, 6×{n}×{n} lights, {basis}; {} channel(s) in {} shard(s)\n"
        "  {}, {:.0f} bytes and {:.0f} non-zeros per pixel\n",
        d.at("directory").get<std::string>(), image.at("width").get<int>(),
        image.at("height").get<int>(), d.at("colour").at("channels").get<int>(),
        d.at("shards").get<int>(), megabytes(bytes), bytes / pixels,
        d.at("nonzeros").get<double>() / pixels,
        fmt::arg("n", d.at("basis").at("face_resolution").get<int>()),
        fmt::arg("basis", basis_text(d.at("basis"))));
    const auto& measured = d.at("measured");
    if (measured.contains("cells")) {
        for (const auto& [name, cells] : measured.at("cells").items()) {
            text += fmt::format("  {:9} {:>12} cells {:>13} non-zeros {:>12}\n", name,
                                cells.at("cells").get<std::uint64_t>(),
                                cells.at("nonzeros").get<std::uint64_t>(),
                                megabytes(cells.at("bytes").get<double>()));
        }
    }
    if (measured.contains("quantisation_error")) {
        for (const auto& [light, error] : measured.at("quantisation_error").items()) {
            text += fmt::format(
                "  quantisation error under {} light: L2 {:.2e}, gradient {:.2e}\n", light,
                error.at("relative_l2").get<double>(), error.at("relative_h1").get<double>());
        }
    }
    if (measured.contains("chroma_residual")) {
        text += fmt::format("  what one channel would lose: L2 {:.2e}\n",
                            measured.at("chroma_residual").get<double>());
    }
    if (const auto& report = d.at("report"); report.is_object() && report.contains("seconds")) {
        text +=
            fmt::format("  baked in {:.1f} s: {:.1f} Mrays/s of visibility, peak memory {}\n",
                        report.at("seconds").at("total").get<double>(),
                        report.at("rays_per_second").at("visibility").get<double>() / 1e6,
                        megabytes(report.at("peak_memory_bytes").get<double>()));
    }
    return text;
}

std::vector<std::string> find_faults(const std::filesystem::path& directory) {
    std::vector<std::string> faults;
    collect(faults, [&] {
        const std::filesystem::path path = directory / "manifest.json";
        const transport::MappedFile file(path);
        const auto bytes = file.bytes();
        const auto manifest = transport::manifest_from_text(
            {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
        for (const transport::ShardRecord& shard : manifest.shards) {
            collect(faults,
                    [&] { const transport::ShardReader reader(directory / shard.file); });
        }
    });
    if (faults.empty()) {
        collect(faults, [&] { static_cast<void>(transport::Transport::open(directory)); });
    }
    return faults;
}

}  // namespace relume::bake
