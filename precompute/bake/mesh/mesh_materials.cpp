#include "precompute/bake/mesh/mesh_materials.h"

#include "precompute/factors/brdf_lobes.h"
#include "precompute/factors/merl_brdf.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace relume::bake {
namespace {

constexpr std::uint32_t kMostTexels = 4096;  // along a side
constexpr std::uint32_t kPlaces = 64;        // along a side, that means are taken over

struct Grid {
    std::uint32_t width = 1;
    std::uint32_t height = 1;

    [[nodiscard]] Imath::V2f uv(std::uint32_t x, std::uint32_t y) const {
        return {(static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                1 - (static_cast<float>(y) + 0.5F) / static_cast<float>(height)};
    }
};

// Of what a material's colours are made of.
std::vector<scene::TextureUse> colour_textures(const scene::Material& material) {
    std::vector<scene::TextureUse> uses;
    for (const auto& use :
         {material.base_texture, material.specular_texture, material.surface_texture,
          material.dielectric_texture, material.dielectric_colour_texture,
          material.exponent_texture, material.gloss_texture}) {
        if (use) {
            uses.push_back(*use);
        }
    }
    return uses;
}

Grid grid_of(const scene::Scene& scene, const std::vector<scene::TextureUse>& uses) {
    Grid grid;
    for (const scene::TextureUse& use : uses) {
        const scene::Texture& texture = scene.textures[use.texture];
        grid.width = std::min(std::max(grid.width, texture.width()), kMostTexels);
        grid.height = std::min(std::max(grid.height, texture.height()), kMostTexels);
    }
    return grid;
}

transport::TextureWrap wrap_from(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::mirror:
            return transport::TextureWrap::mirror;
        case scene::Wrap::clamp:
            return transport::TextureWrap::clamp;
        case scene::Wrap::repeat:
            break;
    }
    return transport::TextureWrap::repeat;
}

// What a BRDF may be called.
std::string shown_name(const std::string& name) {
    return scene::shown_text(name).substr(0, brdf::FactoredBrdf::kMostNameBytes);
}

float shape_of(const scene::Bsdf& bsdf) {
    return bsdf.model() == scene::BsdfModel::phong ? bsdf.exponent() : bsdf.alpha();
}

class MaterialReader {
  public:
    MaterialReader(const scene::Scene& scene, std::size_t number, MeshMaterials& out)
        : scene_(scene),
          material_(scene.materials[number]),
          uses_(colour_textures(material_)),
          grid_(grid_of(scene, uses_)),
          out_(out) {}

    void read(const factors::FactorOptions& options) {
        const scene::Bsdf mean = mean_bsdf();
        factors::Factorisation factored =
            factors::factorise(shown_name(material_.name), mean, options);
        std::vector<transport::LobeRecord> lobes;
        for (std::uint32_t lobe = 0; lobe < factored.brdf.lobes; ++lobe) {
            lobes.push_back(lobe_record(lobe));
        }
        add(std::move(factored), std::move(lobes));
        note_what_is_lost();
    }

    void read(const MeasuredBrdf& measured, const factors::FactorOptions& options) {
        const factors::BrdfLobes lobes = factors::lobes_of(measured.brdf);
        std::vector<transport::LobeRecord> records;
        for (const Imath::V3f& colour : lobes.mean_colours) {
            records.push_back({.colour = colour, .texture = {}});
        }
        add(factors::factorise(shown_name(material_.name), lobes, options), std::move(records));
        note(
            fmt::format("reflects as {} was measured; light that comes from it to others is "
                        "that of a matte surface of its mean colour",
                        measured.file.string()));
        if (const std::size_t count = measured.brdf.unmeasured_count(); count > 0) {
            note(
                fmt::format("{} of {} values of {} are negative, which says that nothing was "
                            "measured, and count as 0",
                            count, 3 * factors::MerlBrdf::kCells, measured.file.string()));
        }
        note_what_is_lost();
    }

  private:
    void add(factors::Factorisation factored, std::vector<transport::LobeRecord> lobes) {
        out_.records.push_back({.name = material_.name,
                                .brdf = static_cast<std::uint32_t>(out_.factored.size()),
                                .lobes = std::move(lobes),
                                .cutout = cutout_record()});
        out_.factored.push_back(std::move(factored));
    }

    // Alpha, as a texture of its own.
    [[nodiscard]] std::optional<transport::CutoutRecord> cutout_record() {
        if (!material_.has_holes()) {
            return std::nullopt;
        }
        transport::SurfaceTexture texture{.width = 1, .height = 1, .rgb = {}};
        const scene::Texture* alpha = nullptr;
        if (material_.base_texture) {
            alpha = &scene_.textures[material_.base_texture->texture];
            texture.width = std::min(alpha->width(), kMostTexels);
            texture.height = std::min(alpha->height(), kMostTexels);
            texture.wrap_u = wrap_from(alpha->wrap_u());
            texture.wrap_v = wrap_from(alpha->wrap_v());
        }
        const Grid grid{.width = texture.width, .height = texture.height};
        for (std::uint32_t y = 0; y < grid.height; ++y) {
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const float of_texel = alpha != nullptr ? alpha->evaluate(grid.uv(x, y)).w : 1;
                const half value = std::max(0.0F, material_.opacity * of_texel);
                texture.rgb.insert(texture.rgb.end(), 3, value);
            }
        }
        out_.textures.push_back(std::move(texture));
        return transport::CutoutRecord{
            .texture = static_cast<std::uint32_t>(out_.textures.size() - 1),
            .cutoff = *material_.alpha_cutoff};
    }

    void note(const std::string& what) {
        out_.notes.push_back(fmt::format("material '{}': {}", material_.name, what));
    }

    [[nodiscard]] scene::Bsdf bsdf_at(const Imath::V2f& uv) const {
        scene::PointUvs uvs;
        uvs.of_set.fill(uv);
        return material_.bsdf_at(scene_.textures, uvs, {1, 1, 1});
    }

    // Of the shape in the middle of all shapes, with the mean of all colours.
    [[nodiscard]] scene::Bsdf mean_bsdf() {
        const Grid places{.width = std::min(grid_.width, kPlaces),
                          .height = std::min(grid_.height, kPlaces)};
        std::vector<scene::Bsdf> bsdfs;
        for (std::uint32_t y = 0; y < places.height; ++y) {
            for (std::uint32_t x = 0; x < places.width; ++x) {
                bsdfs.push_back(bsdf_at(places.uv(x, y)));
            }
        }
        std::stable_sort(bsdfs.begin(), bsdfs.end(),
                         [](const scene::Bsdf& a, const scene::Bsdf& b) {
                             return shape_of(a) < shape_of(b);
                         });
        shape_varies_ = shape_of(bsdfs.front()) != shape_of(bsdfs.back());
        return bsdfs[bsdfs.size() / 2].with_mean_colours(bsdfs);
    }

    [[nodiscard]] transport::LobeRecord lobe_record(std::uint32_t lobe) {
        std::vector<Imath::V3f> colours(std::size_t{grid_.width} * grid_.height);
        tbb::parallel_for(std::uint32_t{0}, grid_.height, [&](std::uint32_t y) {
            for (std::uint32_t x = 0; x < grid_.width; ++x) {
                colours[std::size_t{y} * grid_.width + x] =
                    factors::lobe_colours(bsdf_at(grid_.uv(x, y)))[lobe];
            }
        });
        const bool is_constant =
            std::all_of(colours.begin(), colours.end(),
                        [&](const Imath::V3f& colour) { return colour == colours.front(); });
        if (is_constant) {
            return {.colour = colours.front(), .texture = {}};
        }
        const scene::Texture& first = scene_.textures[uses_.front().texture];
        transport::SurfaceTexture texture{.width = grid_.width,
                                          .height = grid_.height,
                                          .wrap_u = wrap_from(first.wrap_u()),
                                          .wrap_v = wrap_from(first.wrap_v()),
                                          .rgb = {}};
        for (const Imath::V3f& colour : colours) {
            texture.rgb.insert(texture.rgb.end(),
                               {half(colour.x), half(colour.y), half(colour.z)});
        }
        out_.textures.push_back(std::move(texture));
        return {.colour = {1, 1, 1},
                .texture = static_cast<std::uint32_t>(out_.textures.size() - 1)};
    }

    void note_what_is_lost() {
        if (shape_varies_) {
            note("its roughness varies, and is taken as its median");
        }
        if (material_.normal_texture) {
            note("its normal map is not shown");
        }
        const bool has_opacities = std::any_of(
            scene_.meshes.begin(), scene_.meshes.end(), [&](const scene::Mesh& mesh) {
                return !mesh.opacities.empty() &&
                       &scene_.materials[mesh.material] == &material_;
            });
        if (material_.has_holes() && has_opacities) {
            note("opacities of vertices let light through its holes, and are not seen");
        }
        if (std::any_of(uses_.begin(), uses_.end(),
                        [](const scene::TextureUse& use) { return use.uv_set != 0; })) {
            note("its textures are looked up by the first texture coordinates");
        }
        const bool has_colours = std::any_of(
            scene_.meshes.begin(), scene_.meshes.end(), [&](const scene::Mesh& mesh) {
                return !mesh.colours.empty() && &scene_.materials[mesh.material] == &material_;
            });
        if (has_colours && out_.factored.back().brdf.lobes > 1) {
            note("colours of vertices dye its highlights as well");
        }
    }

    const scene::Scene& scene_;
    const scene::Material& material_;
    std::vector<scene::TextureUse> uses_;
    Grid grid_;
    MeshMaterials& out_;
    bool shape_varies_ = false;
};

}  // namespace

std::vector<brdf::FactoredBrdf> MeshMaterials::brdfs() const {
    std::vector<brdf::FactoredBrdf> brdfs;
    for (const factors::Factorisation& one : factored) {
        brdfs.push_back(one.brdf);
    }
    return brdfs;
}

MeshMaterials mesh_materials(const scene::Scene& scene,
                             std::span<const MeasuredBrdf> measured,
                             const factors::FactorOptions& options) {
    MeshMaterials materials;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        MaterialReader reader(scene, i, materials);
        if (const auto* brdf = measured_brdf_of(measured, scene.materials[i].name)) {
            reader.read(*brdf, options);
        } else {
            reader.read(options);
        }
    }
    return materials;
}

}  // namespace relume::bake
