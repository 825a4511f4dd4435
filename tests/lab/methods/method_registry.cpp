#include "tests/lab/methods/families.h"
#include "tests/lab/methods/method.h"

#include <fmt/format.h>

#include <stdexcept>

namespace relume::lab {
namespace {

std::vector<MethodFamily> all_families() {
    std::vector<MethodFamily> families;
    for (const auto& add :
         {add_session_families, add_selector_families, add_sh_families, add_surface_families}) {
        add(families);
    }
    return families;
}

bool is_of(const MethodFamily& family, std::string_view text) {
    return text.size() > family.name.size() && text.starts_with(family.name) &&
           text[family.name.size()] == '-';
}

}  // namespace

const std::vector<MethodFamily>& method_families() {
    static const std::vector<MethodFamily> families = all_families();
    return families;
}

Method method_from_text(std::string_view text) {
    const MethodFamily* best = nullptr;
    for (const MethodFamily& family : method_families()) {
        if (is_of(family, text) &&
            (best == nullptr || family.name.size() > best->name.size())) {
            best = &family;
        }
    }
    if (best == nullptr) {
        throw std::invalid_argument(
            fmt::format("method '{}': expected one of\n{}", text, method_help()));
    }
    try {
        return best->parse(text.substr(best->name.size() + 1));
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("method '{}': expected {}-{}: {}", text,
                                                best->name, best->form, error.what()));
    }
}

std::string method_help() {
    std::string help;
    for (const MethodFamily& family : method_families()) {
        help += fmt::format("  {:<34} {}\n", family.name + "-" + family.form, family.summary);
    }
    return help;
}

}  // namespace relume::lab
