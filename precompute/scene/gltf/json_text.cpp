#include "precompute/scene/gltf/json_text.h"

#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace relume::scene::gltf {
namespace {

constexpr int kDeepest = 64;
// A parsed document takes several times its text; data of this size belongs into a buffer.
constexpr std::size_t kLongest = std::size_t{512} << 20;

// U+F700 + byte, three bytes of UTF-8: 0xEF, 0x9C + byte/64, 0x80 + byte%64.
std::string private_character(std::uint8_t byte) {
    return {static_cast<char>(0xEF), static_cast<char>(0x9C + byte / 64),
            static_cast<char>(0x80 + byte % 64)};
}

std::string made_utf8(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0)
            out += private_character(static_cast<std::uint8_t>(text.front()));
        else
            out.append(text.substr(0, length));
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0)
            return false;
        text.remove_prefix(length);
    }
    return true;
}

}  // namespace

nlohmann::json parse_json(std::string_view text, const FileName& file) {
    if (text.size() > kLongest)
        file.refuse(SceneFault::too_large, fmt::format("JSON of {} bytes; expected at most {}",
                                                       text.size(), kLongest));
    // A GLB's JSON is padded with spaces, by some with zeros.
    while (!text.empty() && text.back() == '\0')
        text.remove_suffix(1);
    std::string repaired;
    if (!is_utf8(text)) {
        repaired = made_utf8(text);
        text = repaired;
    }
    const auto bounded = [&](int depth, nlohmann::json::parse_event_t /*event*/,
                             nlohmann::json& /*parsed*/) {
        if (depth > kDeepest)
            file.refuse(SceneFault::corrupt_file,
                        fmt::format("JSON of more than {} levels", kDeepest));
        return true;
    };
    nlohmann::json document;
    try {
        document = nlohmann::json::parse(text, bounded);
    } catch (const nlohmann::json::exception& error) {
        file.refuse(SceneFault::corrupt_file,
                    fmt::format("no JSON: {}", shown_text(error.what())));
    }
    if (!document.is_object())
        file.refuse(SceneFault::corrupt_file, "its JSON is no object");
    return document;
}

std::string original_bytes(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (i + 2 < text.size() && byte(i) == 0xEF && byte(i + 1) >= 0x9E &&
            byte(i + 1) <= 0x9F) {
            out.push_back(static_cast<char>((byte(i + 1) - 0x9C) * 64 + byte(i + 2) - 0x80));
            i += 2;
        } else {
            out.push_back(text[i]);
        }
    }
    return out;
}

}  // namespace relume::scene::gltf
