#include "server/engine/kernels/target.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <string_view>

namespace relume::engine {
namespace {

std::string_view forced_name() {
    const char* name = std::getenv("RELUME_FORCE_TARGET");
    return name == nullptr ? "" : name;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return text;
}

void force_target(std::string_view name) {
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (lower(hwy::TargetName(target)) == name) {
            hwy::SetSupportedTargetsForTest(target);
            return;
        }
    }
    throw std::runtime_error(fmt::format(
        "RELUME_FORCE_TARGET={}: expected scalar or a target this processor has", name));
}

}  // namespace

bool scalar_is_forced() {
    return forced_name() == "scalar";
}

void apply_forced_target() {
    static std::once_flag once;
    std::call_once(once, [] {
        if (!forced_name().empty() && !scalar_is_forced()) {
            force_target(forced_name());
        }
    });
}

std::string target_name() {
    if (scalar_is_forced()) {
        return "scalar";
    }
    apply_forced_target();
    const int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    return lower(hwy::TargetName(targets & -targets));
}

}  // namespace relume::engine
