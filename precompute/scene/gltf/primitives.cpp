#include "precompute/scene/gltf/primitives.h"

#include "precompute/scene/gltf/draco.h"
#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/gltf/triangles.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <type_traits>
#include <utility>

namespace relume::scene::gltf {
namespace {

using Vertices = std::vector<std::uint32_t>;

bool is_triangles(int mode) {
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

Imath::V3d triple(const Elements& elements, std::size_t i) {
    return {elements.number(i, 0), elements.number(i, 1), elements.number(i, 2)};
}

// The attributes of one primitive, compressed ones first.
class Attributes {
  public:
    Attributes(const tinygltf::Primitive& primitive,
               const DracoMesh* draco,
               Accessors& accessors,
               const FileName& file,
               const std::string& who)
        : primitive_(primitive), draco_(draco), accessors_(accessors), file_(file), who_(who) {}

    // Nothing where the primitive has no such attribute. Throws SceneError where it has fewer
    // than `count` elements.
    [[nodiscard]] std::optional<Elements> find(const std::string& name,
                                               std::initializer_list<std::size_t> widths,
                                               std::size_t count) const {
        if (draco_ != nullptr) {
            if (const auto found = draco_->attributes.find(name);
                found != draco_->attributes.end())
                return checked(found->second, name, widths, count);
        }
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end())
            return std::nullopt;
        return checked(
            accessors_.elements(found->second, widths, fmt::format("{} of {}", name, who_)),
            name, widths, count);
    }

  private:
    [[nodiscard]] Elements checked(Elements elements,
                                   const std::string& name,
                                   std::initializer_list<std::size_t> widths,
                                   std::size_t count) const {
        if (std::find(widths.begin(), widths.end(), elements.width()) == widths.end() ||
            elements.count() < count)
            file_.refuse(SceneFault::corrupt_file,
                         fmt::format("{}: {} has {} elements of {} numbers; expected {} of {}",
                                     who_, shown_text(name), elements.count(), elements.width(),
                                     count, fmt::join(widths.begin(), widths.end(), " or ")));
        return elements;
    }

    const tinygltf::Primitive& primitive_;
    const DracoMesh* draco_;
    Accessors& accessors_;
    const FileName& file_;
    const std::string& who_;
};

// What morph targets add to the vertices, each by its weight.
class Morphs {
  public:
    Morphs(const tinygltf::Primitive& primitive,
           std::span<const double> weights,
           Accessors& accessors,
           const std::string& who)
        : primitive_(primitive), weights_(weights), accessors_(accessors), who_(who) {}

    template <typename Value>
    void add(const char* attribute,
             const Vertices& vertices,
             std::vector<Value>& values) const {
        for (std::size_t k = 0; k < std::min(weights_.size(), primitive_.targets.size()); ++k) {
            const auto found = primitive_.targets[k].find(attribute);
            if (weights_[k] == 0 || found == primitive_.targets[k].end() || values.empty())
                continue;
            const std::string self =
                fmt::format("{} of morph target {} of {}", attribute, k, who_);
            const Elements deltas = accessors_.elements(found->second, {3}, self);
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                if (vertices[i] >= deltas.count())
                    accessors_.file().refuse(
                        SceneFault::corrupt_file,
                        fmt::format("{} has {} elements; expected one for vertex {}", self,
                                    deltas.count(), vertices[i]));
                const Imath::V3d delta = triple(deltas, vertices[i]) * weights_[k];
                for (int c = 0; c < 3; ++c)
                    values[i][c] += static_cast<std::decay_t<decltype(values[i][c])>>(delta[c]);
            }
        }
    }

    // Attributes that targets of some weight change and that are not added.
    [[nodiscard]] std::set<std::string> others() const {
        std::set<std::string> names;
        for (std::size_t k = 0; k < std::min(weights_.size(), primitive_.targets.size()); ++k) {
            for (const auto& entry : primitive_.targets[k]) {
                const std::string& name = entry.first;
                if (weights_[k] != 0 && name != "POSITION" && name != "NORMAL" &&
                    name != "TANGENT")
                    names.insert(shown_text(original_bytes(name)));
            }
        }
        return names;
    }

  private:
    const tinygltf::Primitive& primitive_;
    std::span<const double> weights_;
    Accessors& accessors_;
    const std::string& who_;
};

Influences influences_of(const Attributes& attributes,
                         const Vertices& vertices,
                         std::size_t count) {
    Influences influences;
    for (int set = 0;; ++set) {
        const auto joints = attributes.find(fmt::format("JOINTS_{}", set), {4}, count);
        const auto weights = attributes.find(fmt::format("WEIGHTS_{}", set), {4}, count);
        if (!joints || !weights)
            return influences;
        const std::size_t before = influences.per_vertex;
        const std::size_t after = before + 4;
        std::vector<std::uint32_t> all_joints(after * vertices.size());
        std::vector<float> all_weights(after * vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            for (std::size_t k = 0; k < after; ++k) {
                const bool is_known = k < before;
                all_joints[i * after + k] = is_known ? influences.joints[i * before + k]
                                                     : joints->whole(vertices[i], k - before);
                all_weights[i * after + k] = is_known
                                                 ? influences.weights[i * before + k]
                                                 : weights->number(vertices[i], k - before);
            }
        }
        influences = {after, std::move(all_joints), std::move(all_weights)};
    }
}

}  // namespace

std::optional<PrimitiveShape> PrimitiveReader::read(const tinygltf::Primitive& primitive,
                                                    std::span<const double> morph_weights,
                                                    bool is_skinned,
                                                    const std::string& who) {
    const auto refuse = [&](SceneFault fault, const std::string& why) {
        document_.file.refuse(fault, fmt::format("{}: {}", who, why));
    };
    std::optional<DracoMesh> draco;
    if (is_draco(primitive))
        draco = decode_draco(primitive, document_, views_, who);
    const Attributes attributes(primitive, draco ? &*draco : nullptr, accessors_,
                                document_.file, who);
    const auto positions = attributes.find("POSITION", {3}, 0);
    if (!positions)
        return std::nullopt;  // glTF 2.0 §3.7.2.1: to be skipped
    Vertices corners;
    if (draco) {
        corners = std::move(draco->indices);
    } else if (primitive.indices >= 0) {
        const Elements indices =
            accessors_.elements(primitive.indices, {1}, fmt::format("indices of {}", who));
        corners.resize(indices.count());
        for (std::size_t i = 0; i < corners.size(); ++i)
            corners[i] = indices.whole(i, 0);
    } else {
        corners.resize(positions->count());
        std::iota(corners.begin(), corners.end(), 0U);
    }
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        refuse(SceneFault::corrupt_file,
               fmt::format("mode {}; expected 0 to 6", primitive.mode));
    if (!is_triangles(primitive.mode)) {
        left_out_.points_and_lines += corners.size();
        return std::nullopt;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] >= positions->count())
            refuse(SceneFault::index_out_of_range,
                   fmt::format("index {} is {}; expected below {}", i, corners[i],
                               positions->count()));
    }
    // Draco has whole triangles, whatever the primitive would have made of corners.
    const int mode = draco ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode == TINYGLTF_MODE_TRIANGLES)
        left_out_.loose_indices += corners.size() % 3;

    const MaterialUse& use = materials_.use(primitive.material, who);
    PrimitiveShape shape;
    Mesh& mesh = shape.mesh;
    mesh.material = use.material;
    mesh.triangles = triangles_of(mode, corners);
    const std::size_t count = positions->count();
    const Vertices vertices = take_used_vertices(mesh.triangles, count);
    const auto each = [&](const auto& read_one) {
        for (const std::uint32_t vertex : vertices)
            read_one(vertex);
    };
    each([&](std::size_t v) { shape.positions.push_back(triple(*positions, v)); });
    if (const auto normals = attributes.find("NORMAL", {3}, count))
        each([&](std::size_t v) { mesh.normals.emplace_back(triple(*normals, v)); });
    if (const auto tangents = attributes.find("TANGENT", {4}, count)) {
        each([&](std::size_t v) {
            const Imath::V3f t(triple(*tangents, v));
            mesh.tangents.emplace_back(t.x, t.y, t.z,
                                       tangents->number(v, 3) < 0 ? -1.0F : 1.0F);
        });
    }
    const Morphs morphs(primitive, morph_weights, accessors_, who);
    morphs.add("POSITION", vertices, shape.positions);
    morphs.add("NORMAL", vertices, mesh.normals);
    morphs.add("TANGENT", vertices, mesh.tangents);
    for (const std::string& attribute : morphs.others())
        report_.unused.push_back(fmt::format("{} of morph targets of {}", attribute, who));
    mesh.more_uvs.resize(std::max<std::size_t>(use.uvs.size(), 1) - 1);
    for (std::size_t set = 0; set < use.uvs.size(); ++set) {
        const UvSource& source = use.uvs[set];
        const auto uvs =
            attributes.find(fmt::format("TEXCOORD_{}", source.texcoord), {2}, count);
        if (!uvs) {
            report_.repairs.push_back(fmt::format(
                "{} has no TEXCOORD_{}, which its material asks for: (0, 0) is taken", who,
                source.texcoord));
            continue;
        }
        std::vector<Imath::V2f>& values = set == 0 ? mesh.uvs : mesh.more_uvs[set - 1];
        each([&](std::size_t v) {
            values.push_back(source.uv_from_file(uvs->number(v, 0), uvs->number(v, 1)));
        });
    }
    if (const auto colours = attributes.find("COLOR_0", {3, 4}, count)) {
        each([&](std::size_t v) { mesh.colours.emplace_back(triple(*colours, v)); });
        if (colours->width() == 4 && materials_.has_holes(use))
            each([&](std::size_t v) { mesh.opacities.push_back(colours->number(v, 3)); });
    }
    if (is_skinned)
        shape.influences = influences_of(attributes, vertices, count);
    return shape;
}

}  // namespace relume::scene::gltf
