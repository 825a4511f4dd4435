#include "protocol/light/exr_layers.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace relume::light {
namespace {

constexpr std::size_t kLayersShown = 24;

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

std::string printable(std::string_view text) {
    std::string result(text);
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return result;
}

std::string_view last_component(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

// Channels of one part with one prefix.
struct Group {
    std::size_t part = 0;
    std::string prefix;                 // without the last dot; of V-Ray's ".R" empty
    std::vector<std::string> channels;  // whole names
};

std::vector<Group> groups_of(std::span<const ExrPart> parts) {
    std::vector<Group> groups;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        for (const ExrChannel& channel : parts[part].channels) {
            const std::size_t dot = channel.name.rfind('.');
            const std::string prefix =
                dot == std::string::npos ? "" : channel.name.substr(0, dot);
            const auto found =
                std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
                    return group.part == part && group.prefix == prefix;
                });
            Group& group =
                found != groups.end() ? *found : groups.emplace_back(Group{part, prefix, {}});
            group.channels.push_back(channel.name);
        }
    }
    return groups;
}

// The channel whose last component is one of these names, if any.
std::string channel_named(const Group& group, std::initializer_list<std::string_view> names) {
    for (const std::string& channel : group.channels) {
        const std::string last = lower_case(last_component(channel));
        if (std::find(names.begin(), names.end(), last) != names.end()) {
            return channel;
        }
    }
    return {};
}

// Some writers repeat the part's name before each channel.
std::string label_of(const Group& group, const ExrPart& part) {
    if (group.prefix.empty() || group.prefix == part.name || part.name.empty()) {
        return printable(group.prefix.empty() ? part.name : group.prefix);
    }
    return printable(group.prefix.starts_with(part.name + ".")
                         ? group.prefix
                         : part.name + "." + group.prefix);
}

std::optional<ExrLayer> layer_from(const Group& group, const ExrPart& part) {
    ExrLayer layer;
    layer.label = label_of(group, part);
    layer.part = group.part;
    const std::string red = channel_named(group, {"r", "red"});
    const std::string green = channel_named(group, {"g", "green"});
    const std::string blue = channel_named(group, {"b", "blue"});
    if (!red.empty() && !green.empty() && !blue.empty()) {
        layer.channels = {red, green, blue};
        return layer;
    }
    const std::string luminance = channel_named(group, {"y", "l", "luminance", "grey", "gray"});
    const std::string red_chroma = channel_named(group, {"ry"});
    const std::string blue_chroma = channel_named(group, {"by"});
    // With X or Z beside it, Y is a coordinate.
    if (luminance.empty() || !channel_named(group, {"x", "z"}).empty()) {
        return std::nullopt;
    }
    if (!red_chroma.empty() && !blue_chroma.empty()) {
        layer.kind = ExrLayer::Kind::luminance_chroma;
        layer.channels = {luminance, red_chroma, blue_chroma};
        return layer;
    }
    layer.kind = ExrLayer::Kind::grey;
    layer.channels = {luminance, luminance, luminance};
    return layer;
}

// Every prefix with its channels, for messages: "ViewLayer.Normal (X, Y, Z)".
std::string describe(std::span<const ExrPart> parts) {
    std::vector<std::string> texts;
    for (const Group& group : groups_of(parts)) {
        if (texts.size() == kLayersShown) {
            texts.emplace_back("…");
            break;
        }
        std::vector<std::string> names;
        for (const std::string& channel : group.channels) {
            if (names.size() == kLayersShown) {
                break;
            }
            names.push_back(printable(last_component(channel)));
        }
        const std::string label = label_of(group, parts[group.part]);
        texts.push_back(
            fmt::format("{} ({})", label.empty() ? "no name" : label, fmt::join(names, ", ")));
    }
    return fmt::format("{}", fmt::join(texts, "; "));
}

bool is_beauty(std::string_view label) {
    constexpr std::array<std::string_view, 12> kNames{
        "combined", "beauty", "rgba",      "rgb",  "color", "colour",
        "image",    "final",  "composite", "main", "c",     "rgb_color"};
    const std::string name = lower_case(last_component(label));
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

// What lights nothing: data that renderers write beside the picture.
bool is_data(std::string_view label) {
    constexpr std::array<std::string_view, 24> kParts{
        "depth",         "normal",        "albedo",   "position",    "occlusion", "crypto",
        "mist",          "motion",        "vector",   "velocity",    "denois",    "indexob",
        "indexma",       "matte",         "mask",     "diffcol",     "glosscol",  "transcol",
        "diffuse_color", "diffusefilter", "objectid", "material_id", "shadow",    "coverage"};
    constexpr std::array<std::string_view, 14> kNames{"ao",    "z",      "n",   "p",   "uv",
                                                      "id",    "a",      "st",  "pz",  "nn",
                                                      "alpha", "zdepth", "ids", "pref"};
    const std::string whole = lower_case(label);
    const std::string name = lower_case(last_component(label));
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end() ||
           std::any_of(kParts.begin(), kParts.end(), [&](std::string_view part) {
               return whole.find(part) != std::string::npos;
           });
}

[[noreturn]] void refuse_layers(std::span<const ExrPart> parts, const std::string& expected) {
    refuse_image("picture", "one of several or none: " + describe(parts), expected);
}

std::string names_of(const std::vector<ExrLayer>& layers) {
    std::vector<std::string> names;
    for (const ExrLayer& layer : layers) {
        if (names.size() == kLayersShown) {
            break;
        }
        names.push_back(layer.label.empty() ? "(no name)" : layer.label);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<ExrLayer> colour_layers(std::span<const ExrPart> parts) {
    std::vector<ExrLayer> layers;
    for (const Group& group : groups_of(parts)) {
        if (const auto layer = layer_from(group, parts[group.part])) {
            layers.push_back(*layer);
        }
    }
    return layers;
}

ExrLayer choose_layer(std::span<const ExrPart> parts,
                      const std::string& label,
                      std::vector<std::string>& warnings) {
    const std::vector<ExrLayer> layers = colour_layers(parts);
    const auto first = [&](auto matches) -> const ExrLayer* {
        const auto found = std::find_if(layers.begin(), layers.end(), matches);
        return found == layers.end() ? nullptr : &*found;
    };
    if (!label.empty()) {
        if (const ExrLayer* layer =
                first([&](const ExrLayer& l) { return l.label == label; })) {
            return *layer;
        }
        if (const ExrLayer* layer = first(
                [&](const ExrLayer& l) { return lower_case(l.label) == lower_case(label); })) {
            return *layer;
        }
        refuse_image("layer", printable(label),
                     layers.empty() ? "one that holds colours, and this file holds none: " +
                                          describe(parts)
                                    : "one of " + names_of(layers));
    }
    if (layers.empty()) {
        refuse_layers(parts, "channels R, G and B, or Y");
    }
    const bool is_single = parts.size() == 1;
    // Without a prefix: what V-Ray, Arnold and Nuke call the beauty.
    if (const ExrLayer* layer = first([&](const ExrLayer& l) {
            return is_single ? l.label.empty()
                             : is_beauty(l.label) && !is_data(parts[l.part].name);
        })) {
        return *layer;
    }
    if (const ExrLayer* layer = first([](const ExrLayer& l) { return is_beauty(l.label); })) {
        if (layers.size() > 1) {
            warnings.push_back(
                fmt::format("layer {} is used, of {}", layer->label, names_of(layers)));
        }
        return *layer;
    }
    std::vector<ExrLayer> usable;
    std::copy_if(layers.begin(), layers.end(), std::back_inserter(usable),
                 [](const ExrLayer& l) { return !is_data(l.label); });
    // Parts are written with the picture first, where they are named after nothing known.
    if (usable.size() == 1 || (!usable.empty() && !is_single)) {
        warnings.push_back(
            fmt::format("layer {} is used, of {}", usable.front().label, names_of(layers)));
        return usable.front();
    }
    refuse_layers(parts, "layer= with one of " + names_of(layers));
}

}  // namespace relume::light
