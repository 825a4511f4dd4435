#include "precompute/scene/gltf/resources.h"

#include "precompute/scene/gltf/container.h"
#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/import_folder.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

namespace relume::scene::gltf {
namespace {

constexpr std::string_view kDataScheme = "data:";

bool is_data(std::string_view uri) {
    return uri.substr(0, kDataScheme.size()) == kDataScheme;
}

// Values of the digits of base64 and of its variant for URLs; -1 for anything else.
constexpr std::array<std::int8_t, 256> make_digits() {
    std::array<std::int8_t, 256> digits{};
    digits.fill(-1);
    constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        digits[static_cast<std::uint8_t>(kAlphabet[i])] = static_cast<std::int8_t>(i);
    digits['-'] = 62;
    digits['_'] = 63;
    return digits;
}

constexpr auto kDigits = make_digits();

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// Nothing where `text` is no base64.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
    while (!text.empty() && (text.back() == '=' || is_blank(text.back())))
        text.remove_suffix(1);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : text) {
        if (is_blank(c))
            continue;
        const std::int8_t digit = kDigits[static_cast<std::uint8_t>(c)];
        if (digit < 0)
            return std::nullopt;
        group = (group << 6U | static_cast<std::uint32_t>(digit)) & 0xFFFFU;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::uint8_t>(group >> static_cast<unsigned>(bits)));
        }
    }
    return bytes;
}

}  // namespace

std::string Resources::shown(const std::string& uri) {
    constexpr std::size_t kEnough = 40;
    if (is_data(uri))
        return shown_text(std::string_view(uri).substr(0, std::min(uri.find(','), kEnough))) +
               ",…";
    return shown_text(original_bytes(uri));
}

std::optional<std::vector<std::uint8_t>> Resources::read(const std::string& uri) {
    std::optional<std::vector<std::uint8_t>> bytes;
    if (is_data(uri)) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos)
            file_.refuse(
                SceneFault::corrupt_file,
                fmt::format("'{}' has no comma; expected data:TYPE;base64,…", shown(uri)));
        const std::string_view content = std::string_view(uri).substr(comma + 1);
        const std::string plain = percent_decoded(std::string(content));
        if (std::string_view(uri).substr(0, comma).ends_with(";base64"))
            bytes = from_base64(plain);
        else
            bytes = std::vector<std::uint8_t>(plain.begin(), plain.end());
        if (!bytes)
            file_.refuse(SceneFault::corrupt_file,
                         fmt::format("'{}' is no base64", shown(uri)));
    } else {
        const auto path = path_inside(folder_, original_bytes(uri));
        std::error_code error;
        if (!path || !std::filesystem::is_regular_file(*path, error))
            return std::nullopt;
        const std::string content = read_file(*path, left_, file_);
        bytes = std::vector<std::uint8_t>(content.begin(), content.end());
    }
    if (bytes->size() > left_)
        file_.refuse(SceneFault::too_large,
                     fmt::format("'{}' has {} bytes; expected at most {}", shown(uri),
                                 bytes->size(), left_));
    left_ -= bytes->size();
    return bytes;
}

}  // namespace relume::scene::gltf
