#include "precompute/bake/verdict.h"

#include "precompute/bake/inspect.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

namespace relume::bake {
namespace {

constexpr std::size_t kMostLines = 20;

// Names out of a scene's file may hold anything; a terminal obeys control characters.
std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return text;
}

void add_list(std::string& text, const char* title, const std::vector<std::string>& lines) {
    if (lines.empty()) {
        return;
    }
    text += fmt::format("  {}:\n", title);
    for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) {
        text += fmt::format("    {}\n", printable(lines[i]));
    }
    if (lines.size() > kMostLines) {
        text += fmt::format("    and {} more, in report.json\n", lines.size() - kMostLines);
    }
}

// A path as a shell takes it.
std::string shell_word(const std::string& text) {
    const bool plain =
        !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
            return std::isalnum(c) != 0 || c == '/' || c == '.' || c == '_' || c == '-' ||
                   c == '+' || c == ',';
        });
    if (plain) {
        return text;
    }
    std::string word = "'";
    for (const char c : text) {
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return word + "'";
}

std::string bounces_text(int bounces) {
    if (bounces == 0) {
        return "direct light alone, without interreflection";
    }
    return fmt::format("direct light and {} bounce{}", bounces, bounces == 1 ? "" : "s");
}

std::string purpose(const nlohmann::json& description) {
    const auto& basis = description.at("basis");
    const auto& image = description.at("image");
    const int bounces = description.at("bake").value("bounces", 0);
    std::string detail;
    if (description.contains("curves")) {
        detail = "curves and diffuse colours of ";
        for (const auto& curve : description.at("curves")) {
            detail += (detail.back() == ' ' ? "" : ", ") + curve.at("name").get<std::string>();
        }
        detail += fmt::format(", under {}, with interreflection as it is",
                              description.at("light").value("environment", "one light"));
    } else if (basis.contains("order")) {
        const int order = basis.at("order").get<int>();
        detail = fmt::format(
            "soft light without sharp shadows, down to some {:.0f}° (spherical "
            "harmonics of order {})",
            180.0 / order, order);
    } else {
        const int n = basis.at("face_resolution").get<int>();
        detail =
            fmt::format("light of any kind, with detail down to {:.1f}° (6×{n}×{n} texels)",
                        90.0 / n, fmt::arg("n", n));
    }
    const std::string view =
        description.contains("vertices")
            ? "any camera"
            : fmt::format("{}×{} pixels from this one camera", image.at("width").get<int>(),
                          image.at("height").get<int>());
    return fmt::format("  good for {}; {}; {}\n", detail, bounces_text(bounces), view);
}

// Of the image, under what.
std::string signals_text(const nlohmann::json& description) {
    return description.contains("curves")
               ? "with likely curves, {} with curves that end abruptly (relative L2)\n"
               : "under a natural map, {} under a bare sun (relative L2)\n";
}

std::string sampling_error(const nlohmann::json& description) {
    const nlohmann::json& error = description.at("sampling_error");
    if (error.is_null()) {
        return {};
    }
    return fmt::format(
        fmt::runtime("  error of its sampling: {} of the image " + signals_text(description)),
        per_cent(error.at("natural").get<double>()), per_cent(error.at("sun").get<double>()));
}

std::string quantisation_error(const nlohmann::json& description) {
    const nlohmann::json& measured = description.at("measured");
    const auto found = measured.find("quantisation_error");
    if (found == measured.end() || !found->contains("natural") || !found->contains("sun")) {
        return {};
    }
    const auto of = [&](const char* light) {
        return found->at(light).at("relative_l2").get<double>();
    };
    return fmt::format(
        fmt::runtime("  error of storing it: {} of the image " + signals_text(description)),
        per_cent(of("natural")), per_cent(of("sun")));
}

}  // namespace

std::string per_cent(double fraction) {
    const double percent = 100 * fraction;
    if (!(percent > 0)) {
        return "0 %";
    }
    // Two digits that count.
    const int decimals =
        std::clamp(1 - static_cast<int>(std::floor(std::log10(percent))), 0, 6);
    return fmt::format("{:.{}f} %", percent, decimals);
}

std::string verdict(const scene::ImportReport& report,
                    const nlohmann::json& description,
                    const std::filesystem::path& directory) {
    std::string text = fmt::format("{} is whole.\n", printable(directory.string()));
    text += purpose(description);
    text += sampling_error(description);
    text += quantisation_error(description);
    text += exactness_text(description.at("basis"));
    text += fmt::format("  {:.1f} MB to keep in memory\n",
                        description.at("bytes").get<double>() / 1e6);
    add_list(text, "not used of the scene", report.unused);
    add_list(text, "repaired in the scene", report.repairs);
    const std::filesystem::path folder =
        directory.has_parent_path() ? directory.parent_path() : ".";
    text += fmt::format("  see it:   {}\n",
                        printable((directory / "view" / "picture.png").string()));
    text += fmt::format("  serve it: relume-server --scenes {}\n", shell_word(folder.string()));
    const std::string name = directory.stem().string();
    text +=
        description.contains("curves")
            ? fmt::format("  look at it: relume render --scene {0} -o {0}.png\n", name)
            : fmt::format(
                  "  light it: relume render --scene {0} --environment FILE.hdr -o {0}.png\n",
                  name);
    return text;
}

}  // namespace relume::bake
