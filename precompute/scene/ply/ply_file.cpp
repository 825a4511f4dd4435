#include "precompute/scene/ply/ply_file.h"

#include "precompute/scene/error.h"
#include "precompute/scene/ply/ply_header.h"
#include "precompute/scene/ply/ply_values.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/srgb.h"
#include "precompute/scene/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

namespace relume::scene::ply {
namespace {

// What a vertex may say.
enum Role : std::uint8_t { x, y, z, nx, ny, nz, u, v, red, green, blue, alpha, role_count };

std::optional<Role> role_of(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Role>, 29> kNames{{
        {"x", x},
        {"y", y},
        {"z", z},
        {"nx", nx},
        {"ny", ny},
        {"nz", nz},
        {"normal_x", nx},
        {"normal_y", ny},
        {"normal_z", nz},
        {"u", u},
        {"v", v},
        {"s", u},
        {"t", v},
        {"texture_u", u},
        {"texture_v", v},
        {"texture_s", u},
        {"texture_t", v},
        {"red", red},
        {"green", green},
        {"blue", blue},
        {"alpha", alpha},
        {"diffuse_red", red},
        {"diffuse_green", green},
        {"diffuse_blue", blue},
        {"r", red},
        {"g", green},
        {"b", blue},
        {"a", alpha},
        {"diffuse_alpha", alpha},
    }};
    const auto found = std::find_if(kNames.begin(), kNames.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found != kNames.end() ? std::optional(found->second) : std::nullopt;
}

// The value that stands for full.
double full_scale(Type type) {
    switch (type) {
        case Type::f32:
        case Type::f64:
            return 1;
        case Type::u16:
        case Type::i16:
            return 65535;
        default:
            return 255;
    }
}

class Reader {
  public:
    Reader(std::string_view file, const std::string& name)
        : name_(name),
          header_(header_from(file, name)),
          values_(file.substr(header_.bytes), header_.encoding, name) {}

    PlyFile read() {
        for (const Element& element : header_.elements) {
            if (!values_.can_hold(element))
                throw SceneError(
                    SceneFault::corrupt_file,
                    fmt::format("scene '{}' ends before its {} elements '{}'; copy it again",
                                name_, element.count, shown_text(element.name)));
            if (element.name == "vertex")
                vertices(element);
            else if (element.name == "face")
                faces(element);
            else if (element.name == "tristrips")
                strips(element);
            else if (!element.properties.empty())
                skip(element);
        }
        check_indices();
        if (file_.mesh.polygons.empty())
            throw SceneError(
                SceneFault::no_geometry,
                fmt::format("scene '{}' holds {} points and no faces; expected a surface: "
                            "faces or triangle strips",
                            name_, file_.mesh.positions.size()));
        file_.pictures = header_.pictures;
        return std::move(file_);
    }

  private:
    void vertices(const Element& element) {
        std::array<bool, role_count> has{};
        std::vector<std::optional<Role>> roles;
        double full = 1;
        for (const Property& property : element.properties) {
            roles.push_back(property.is_list ? std::nullopt : role_of(property.name));
            if (!roles.back())
                continue;
            has[*roles.back()] = true;
            if (*roles.back() == red)
                full = full_scale(property.type);
            if (*roles.back() == x)
                file_.has_single_positions =
                    property.type != Type::f64 && header_.encoding != Encoding::ascii;
        }
        if (!(has[x] && has[y] && has[z]))
            throw SceneError(SceneFault::corrupt_file,
                             fmt::format("scene '{}': its vertices lack x, y or z", name_));
        PolygonMesh& mesh = file_.mesh;
        has_uvs_ = has[u] && has[v];
        has_normals_ = has[nx] && has[ny] && has[nz];
        const bool has_colours = has[red] && has[green] && has[blue];
        for (std::uint64_t i = 0; i < element.count; ++i) {
            std::array<double, role_count> value{};
            value[alpha] = full;
            for (std::size_t k = 0; k < roles.size(); ++k) {
                const Property& property = element.properties[k];
                if (property.is_list)
                    skip_list(property);
                else if (const double read = values_.next(property.type); roles[k])
                    value[*roles[k]] = read;
            }
            mesh.positions.emplace_back(value[x], value[y], value[z]);
            if (has_normals_)
                mesh.normals.emplace_back(float_of(value[nx]), float_of(value[ny]),
                                          float_of(value[nz]));
            if (has_uvs_)
                mesh.uvs.emplace_back(float_of(value[u]), float_of(value[v]));
            if (has_colours)
                mesh.colours.emplace_back(float_of(value[red]), float_of(value[green]),
                                          float_of(value[blue]));
            file_.has_alpha = file_.has_alpha || value[alpha] < full;
        }
        finish_colours(full);
    }

    static float float_of(double value) { return static_cast<float>(value); }

    // Floats beyond 1 are bytes by another name.
    void finish_colours(double full) {
        std::vector<Imath::V3f>& colours = file_.mesh.colours;
        float largest = 0;
        for (const Imath::V3f& c : colours)
            largest = std::max({largest, c.x, c.y, c.z});
        if (full == 1 && largest > 1)
            full = 255;
        for (Imath::V3f& c : colours) {
            c /= float_of(full);
            c = {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)};
        }
    }

    void faces(const Element& element) {
        std::vector<std::uint64_t> indices;
        std::vector<float> uvs;
        for (const Property& property : element.properties)
            file_.has_face_colours = file_.has_face_colours || role_of(property.name) == red;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            indices.clear();
            uvs.clear();
            for (const Property& property : element.properties) {
                if (!property.is_list) {
                    (void)values_.next(property.type);
                } else if (property.name == "vertex_indices" ||
                           property.name == "vertex_index") {
                    for (std::uint64_t n = values_.next_whole(property.count_type); n > 0; --n)
                        indices.push_back(values_.next_whole(property.type));
                } else if (property.name == "texcoord") {
                    for (std::uint64_t n = values_.next_whole(property.count_type); n > 0; --n)
                        uvs.push_back(float_of(values_.next(property.type)));
                } else {
                    skip_list(property);
                }
            }
            if (indices.size() < 3)
                ++file_.short_faces;
            else
                add_polygon(indices,
                            uvs.size() == 2 * indices.size() ? uvs : std::vector<float>());
        }
    }

    // Each vertex makes a triangle with the two before it; −1 begins a new strip.
    void strips(const Element& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                if (!property.is_list) {
                    (void)values_.next(property.type);
                    continue;
                }
                if (property.name != "vertex_indices" && property.name != "vertex_index") {
                    skip_list(property);
                    continue;
                }
                std::vector<std::uint64_t> last;
                bool is_odd = false;
                for (std::uint64_t n = values_.next_whole(property.count_type); n > 0; --n) {
                    const double value = values_.next(property.type);
                    if (value < 0) {
                        last.clear();
                        is_odd = false;
                        continue;
                    }
                    last.push_back(static_cast<std::uint64_t>(std::min(value, 0xFFFFFFFFp0)));
                    if (last.size() < 3)
                        continue;
                    add_polygon(is_odd ? std::vector{last[1], last[0], last[2]} : last, {});
                    is_odd = !is_odd;
                    last.erase(last.begin());
                }
            }
        }
    }

    void add_polygon(const std::vector<std::uint64_t>& indices, const std::vector<float>& uvs) {
        PolygonMesh& mesh = file_.mesh;
        if (mesh.corners.size() + indices.size() >= kNone)
            throw SceneError(SceneFault::too_large,
                             fmt::format("scene '{}' has more corners than indices", name_));
        mesh.polygons.push_back({.first = static_cast<std::uint32_t>(mesh.corners.size()),
                                 .count = static_cast<std::uint32_t>(indices.size())});
        for (std::size_t i = 0; i < indices.size(); ++i) {
            largest_index_ = std::max(largest_index_, indices[i]);
            const auto index =
                static_cast<std::uint32_t>(std::min<std::uint64_t>(indices[i], kNone));
            PolygonCorner corner{.position = index,
                                 .uv = has_uvs_ ? index : kNone,
                                 .normal = has_normals_ ? index : kNone};
            if (!has_uvs_ && !uvs.empty()) {
                corner.uv = static_cast<std::uint32_t>(mesh.uvs.size());
                mesh.uvs.emplace_back(uvs[2 * i], uvs[2 * i + 1]);
            }
            mesh.corners.push_back(corner);
        }
    }

    // Only here, for faces may come before their vertices.
    void check_indices() const {
        if (!file_.mesh.corners.empty() && largest_index_ >= file_.mesh.positions.size())
            throw SceneError(SceneFault::index_out_of_range,
                             fmt::format("scene '{}': a face refers to vertex {}; expected "
                                         "below {}",
                                         name_, largest_index_, file_.mesh.positions.size()));
    }

    void skip_list(const Property& property) {
        for (std::uint64_t n = values_.next_whole(property.count_type); n > 0; --n)
            (void)values_.next(property.type);
    }

    void skip(const Element& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                if (property.is_list)
                    skip_list(property);
                else
                    (void)values_.next(property.type);
            }
        }
    }

    const std::string& name_;
    Header header_;
    Values values_;
    PlyFile file_;
    std::uint64_t largest_index_ = 0;
    bool has_uvs_ = false;
    bool has_normals_ = false;
};

}  // namespace

PlyFile read_ply(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const std::string file = text_of(path, max_bytes);
    const std::string name = shown_text(path.string());
    PlyFile ply = Reader(file, name).read();
    ply.mesh.name = path.stem().string();
    return ply;
}

}  // namespace relume::scene::ply
