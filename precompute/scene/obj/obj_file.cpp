#include "precompute/scene/obj/obj_file.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/srgb.h"
#include "precompute/scene/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

namespace relume::scene::obj {
namespace {

constexpr std::size_t kLongestQuote = 60;

class Reader {
  public:
    Reader(const std::filesystem::path& path, std::string_view text)
        : name_(shown_text(path.string())), lines_(text) {
        file_.mesh.name = path.stem().string();
    }

    ObjFile read() && {
        while (lines_.next())
            statement(lines_.keyword(), lines_.rest());
        check_corners();
        finish_colours();
        return std::move(file_);
    }

  private:
    [[noreturn]] void refuse(SceneFault fault, const std::string& why) const {
        throw SceneError(fault, fmt::format("scene '{}', line {}: '{}': {}", name_,
                                            lines_.number(), quoted(), why));
    }
    [[nodiscard]] std::string quoted() const {
        const std::string whole =
            std::string(lines_.keyword()) + " " + std::string(lines_.rest());
        return shown_text(whole.substr(0, kLongestQuote)) +
               (whole.size() > kLongestQuote ? "…" : "");
    }

    void statement(std::string_view keyword, std::string_view rest) {
        if (keyword == "v")
            vertex(rest);
        else if (keyword == "vt")
            file_.mesh.uvs.push_back(pair(rest));
        else if (keyword == "vn")
            normal(rest);
        else if (keyword == "f" || keyword == "fo")
            face(rest);
        else if (keyword == "usemtl")
            material_ = material_called(std::string(rest));
        else if (keyword == "mtllib")
            file_.libraries.emplace_back(rest);
        else if (keyword == "s")
            smoothing_ = group_from(rest);
        else if (keyword == "p" || keyword == "l")
            ++file_.points_and_lines;
        else if (keyword == "curv" || keyword == "curv2" || keyword == "surf")
            file_.has_free_forms = true;
        // Names of groups and objects, and what display programs keep, say nothing of shape.
    }

    void vertex(std::string_view rest) {
        std::array<double, 7> n{};
        const std::size_t count = take_numbers(rest, n);
        if (count < 3 || (!trimmed(rest).empty() && count < n.size()))
            refuse(SceneFault::corrupt_file, "expected three numbers, or six with a colour");
        file_.mesh.positions.emplace_back(n[0], n[1], n[2]);
        if (count >= 6) {
            file_.mesh.colours.resize(file_.mesh.positions.size() - 1, Imath::V3f(-1));
            file_.mesh.colours.emplace_back(static_cast<float>(n[3]), static_cast<float>(n[4]),
                                            static_cast<float>(n[5]));
        }
    }

    Imath::V2f pair(std::string_view rest) const {
        std::array<double, 2> n{};
        if (take_numbers(rest, n) < 1)
            refuse(SceneFault::corrupt_file, "expected one to three numbers");
        return {static_cast<float>(n[0]), static_cast<float>(n[1])};
    }

    void normal(std::string_view rest) {
        std::array<double, 3> n{};
        if (take_numbers(rest, n) < 3)
            refuse(SceneFault::corrupt_file, "expected three numbers");
        file_.mesh.normals.emplace_back(static_cast<float>(n[0]), static_cast<float>(n[1]),
                                        static_cast<float>(n[2]));
    }

    static std::uint32_t group_from(std::string_view rest) {
        std::uint32_t group = 0;
        (void)std::from_chars(rest.data(), rest.data() + rest.size(), group);  // `off`: 0
        return group == smoothing::kByAngle ? smoothing::kByAngle - 1 : group;
    }

    std::uint32_t material_called(const std::string& name) {
        const auto [known, is_new] =
            materials_.try_emplace(name, static_cast<std::uint32_t>(file_.materials.size()));
        if (is_new)
            file_.materials.push_back(name);
        return known->second;
    }

    // One of the numbers in `1/2/3`: from 1, or backwards from -1 over what has been read.
    std::uint32_t index_from(std::string_view text, std::size_t count_so_far) const {
        std::int64_t value = 0;
        if (text.starts_with('+'))
            text.remove_prefix(1);
        const auto [end, error] =
            std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc{} && end == text.data() + text.size()) {
            const std::int64_t index =
                value > 0 ? value - 1 : static_cast<std::int64_t>(count_so_far) + value;
            if (value != 0 && index >= 0 && index < kNone)
                return static_cast<std::uint32_t>(index);
            refuse(SceneFault::index_out_of_range,
                   fmt::format("corner {} refers to nothing; expected numbers from 1, or from "
                               "-1 backwards to -{}",
                               value, count_so_far));
        }
        refuse(SceneFault::corrupt_file, "expected corners as 1, 1/2, 1//3 or 1/2/3");
    }

    void face(std::string_view rest) {
        PolygonMesh& mesh = file_.mesh;
        const std::size_t first = mesh.corners.size();
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            if (word.front() == '#')
                break;
            PolygonCorner corner;
            const std::array<std::pair<std::uint32_t*, std::size_t>, 3> parts{{
                {&corner.position, mesh.positions.size()},
                {&corner.uv, mesh.uvs.size()},
                {&corner.normal, mesh.normals.size()},
            }};
            std::size_t at = 0;
            for (std::size_t part = 0; part < parts.size() && at <= word.size(); ++part) {
                const std::size_t end = std::min(word.find('/', at), word.size());
                const std::string_view text = word.substr(at, end - at);
                if (part == 0 || !text.empty())
                    *parts[part].first = index_from(text, parts[part].second);
                at = end + 1;
            }
            mesh.corners.push_back(corner);
            if (mesh.corners.size() >= kNone)
                refuse(SceneFault::too_large, "more corners than there are indices");
        }
        const std::size_t count = mesh.corners.size() - first;
        if (count < 3) {
            mesh.corners.resize(first);
            ++file_.points_and_lines;
            return;
        }
        if (!material_)
            material_ = material_called("");
        mesh.polygons.push_back({.first = static_cast<std::uint32_t>(first),
                                 .count = static_cast<std::uint32_t>(count),
                                 .material = *material_,
                                 .smoothing = smoothing_});
    }

    // Only here, for a face may come before what it refers to.
    void check_corners() const {
        const PolygonMesh& mesh = file_.mesh;
        const auto check = [&](std::uint32_t index, std::size_t count, const char* what) {
            if (index != kNone && index >= count)
                throw SceneError(
                    SceneFault::index_out_of_range,
                    fmt::format("scene '{}': a face refers to {} {}; expected 1 to {}", name_,
                                what, std::uint64_t{index} + 1, count));
        };
        for (const PolygonCorner& corner : mesh.corners) {
            check(corner.position, mesh.positions.size(), "vertex");
            check(corner.uv, mesh.uvs.size(), "texture coordinates");
            check(corner.normal, mesh.normals.size(), "normal");
        }
    }

    void finish_colours() {
        std::vector<Imath::V3f>& colours = file_.mesh.colours;
        if (colours.empty())
            return;
        colours.resize(file_.mesh.positions.size(), Imath::V3f(-1));
        float largest = 0;
        for (const Imath::V3f& c : colours)
            largest = std::max({largest, c.x, c.y, c.z});
        file_.has_byte_colours = largest > 1;
        const float scale = file_.has_byte_colours ? 1 / 255.0F : 1.0F;
        for (Imath::V3f& c : colours)
            c = c == Imath::V3f(-1)
                    ? Imath::V3f(1)
                    : Imath::V3f(linear_from_srgb(c.x * scale), linear_from_srgb(c.y * scale),
                                 linear_from_srgb(c.z * scale));
    }

    std::string name_;
    TextLines lines_;
    ObjFile file_;
    std::map<std::string, std::uint32_t> materials_;
    std::optional<std::uint32_t> material_;
    std::uint32_t smoothing_ = smoothing::kByAngle;
};

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const std::string text = text_of(path, max_bytes);
    return Reader(path, text).read();
}

}  // namespace relume::scene::obj
