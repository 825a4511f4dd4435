#include "precompute/scene/obj/mtl_file.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

namespace relume::scene::obj {
namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

Imath::V2f pair_or(const std::array<double, 3>& n, std::size_t count, float otherwise) {
    return {count > 0 ? static_cast<float>(n[0]) : otherwise,
            count > 1 ? static_cast<float>(n[1]) : otherwise};
}

// Options first, then a name that may hold blanks.
MtlTexture texture_from(std::string_view rest) {
    MtlTexture texture;
    while (true) {
        std::string_view after = rest;
        const std::string option = lower(take_word(after));
        std::array<double, 3> n{};
        std::size_t count = 0;
        if (option == "-s" || option == "-o" || option == "-t") {
            count = take_numbers(after, n);
            if (option == "-s")
                texture.transform.scale = pair_or(n, count, 1);
            else if (option == "-o")
                texture.transform.offset = pair_or(n, count, 0);
            else if (n != std::array<double, 3>{})
                texture.ignored += " -t";
        } else if (option == "-bm" || option == "-boost" || option == "-texres") {
            count = take_numbers(after, std::span(n).first(1));
            if (option == "-bm" && count == 1)
                texture.bump = static_cast<float>(n[0]);
        } else if (option == "-mm") {
            count = take_numbers(after, std::span(n).first(2));
            if (n[0] != 0 || (count > 1 && n[1] != 1))
                texture.ignored += " -mm";
        } else if (option == "-clamp") {
            texture.is_clamped = lower(take_word(after)) == "on";
        } else if (option == "-imfchan") {
            const std::string channel = lower(take_word(after));
            texture.channel = channel.empty() ? 'l' : channel.front();
        } else if (option == "-type") {
            texture.ignored += " -type " + lower(take_word(after));
        } else if (option == "-blendu" || option == "-blendv" || option == "-cc") {
            (void)take_word(after);
        } else {
            break;
        }
        rest = after;
    }
    rest = trimmed(rest);
    if (rest.size() >= 2 && rest.front() == '"' && rest.back() == '"')
        rest = rest.substr(1, rest.size() - 2);
    texture.file = rest;
    return texture;
}

class Reader {
  public:
    Reader(std::string name, std::string_view text) : name_(std::move(name)), lines_(text) {}

    std::vector<MtlMaterial> read() && {
        while (lines_.next()) {
            const std::string keyword = lower(lines_.keyword());
            if (keyword == "newmtl") {
                materials_.push_back({.name = std::string(lines_.rest())});
            } else if (!materials_.empty()) {
                statement(keyword, lines_.rest(), materials_.back());
            }
        }
        return std::move(materials_);
    }

  private:
    [[noreturn]] void refuse(const char* expected) const {
        throw SceneError(
            SceneFault::corrupt_file,
            fmt::format("'{}', line {}: '{} {}'; expected {}", name_, lines_.number(),
                        shown_text(lines_.keyword()), shown_text(lines_.rest()), expected));
    }

    std::optional<Imath::V3f> colour(std::string_view rest, MtlMaterial& material) const {
        std::string_view after = rest;
        const std::string_view word = take_word(after);
        if (word == "spectral" || word == "xyz") {
            material.ignored.push_back(fmt::format("{} {}", lines_.keyword(), word));
            return std::nullopt;
        }
        std::array<double, 3> n{};
        const std::size_t count = take_numbers(rest, n);
        if (count == 0 || !std::all_of(n.begin(), n.end(),
                                       [](double x) { return std::isfinite(x) && x >= 0; }))
            refuse("three numbers from 0");
        const auto at = [&](std::size_t i) {  // one number stands for all three
            return static_cast<float>(i < count ? n[i] : n[0]);
        };
        return Imath::V3f(at(0), at(1), at(2));
    }

    float number(std::string_view rest) const {
        if (rest.starts_with("-halo"))
            rest.remove_prefix(5);
        std::array<double, 1> n{};
        if (take_numbers(rest, n) == 0 || !std::isfinite(n[0]))
            refuse("a number");
        return static_cast<float>(n[0]);
    }

    void statement(const std::string& keyword, std::string_view rest, MtlMaterial& m) const {
        if (keyword == "kd")
            m.diffuse = colour(rest, m);
        else if (keyword == "ks")
            m.specular = colour(rest, m);
        else if (keyword == "ke")
            m.emission = colour(rest, m);
        else if (keyword == "ns")
            m.exponent = number(rest);
        else if (keyword == "pr")
            m.roughness = number(rest);
        else if (keyword == "pm")
            m.metallic = number(rest);
        else if (keyword == "d")
            m.dissolve = number(rest);
        else if (keyword == "tr")
            m.dissolve = 1 - number(rest);
        else if (keyword == "bump" || keyword == "norm" || keyword == "disp" ||
                 keyword == "decal" || keyword == "refl")
            m.textures[keyword] = texture_from(rest);
        else if (keyword.starts_with("map_"))
            m.textures[keyword.substr(4)] = texture_from(rest);
        else if ((keyword == "ps" || keyword == "pc" || keyword == "aniso") && number(rest) > 0)
            m.ignored.emplace_back(keyword == "ps"   ? "sheen"
                                   : keyword == "pc" ? "clear coat"
                                                     : "anisotropy");
        // Ka lights by a constant that no bake has; Ni, Tf and illum tell of transparency.
    }

    std::string name_;
    TextLines lines_;
    std::vector<MtlMaterial> materials_;
};

}  // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const std::string text = text_of(path, max_bytes);
    return Reader(shown_text(path.string()), text).read();
}

}  // namespace relume::scene::obj
