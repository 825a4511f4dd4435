// A method of relighting by name: "pbi-30", "nwa-100-area", "guarded-400kB-benefit".
#pragma once

#include "server/scene/scene.h"
#include "tests/lab/methods/contestant.h"
#include "tests/lab/methods/derived_transports.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

// What contestants draw on.
struct LabScene {
    // Reference images are the dense products of this transport.
    std::shared_ptr<const served::Scene> haar;
    // The same view baked in spherical harmonics; empty: there is none.
    std::filesystem::path sh_transport;
    // Of `haar`.
    std::shared_ptr<DerivedTransports> derived = std::make_shared<DerivedTransports>();
};

struct Method {
    std::string label;  // complete: what names the same method again
    // Begins from black. Throws when the scene lacks what the method needs.
    std::function<std::unique_ptr<Contestant>(const LabScene&)> enter;
};

// Methods that are named alike, NAME-REST.
struct MethodFamily {
    std::string name;
    std::string form;     // of the rest, for help: "BUDGET[-PRIORITY]"
    std::string summary;  // for help, a line
    // Throws std::invalid_argument when the rest is not of the form.
    std::function<Method(std::string_view rest)> parse;
};

// All families, in the order of help. One line here registers one (method_registry.cpp).
[[nodiscard]] const std::vector<MethodFamily>& method_families();

// Of the families whose name begins the text, the longest name wins ("pbi-dealer-30" is no
// "pbi"). Throws std::invalid_argument naming what was found and what is expected.
[[nodiscard]] Method method_from_text(std::string_view text);

// NAME-FORM of every family with its summary, a line each.
[[nodiscard]] std::string method_help();

}  // namespace relume::lab
