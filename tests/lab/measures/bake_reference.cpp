#include "tests/lab/measures/bake_reference.h"

#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/rows/direct_light.h"
#include "precompute/bake/rows/path_tracer.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/hash.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace relume::lab {
namespace {

using bake::ReceiverSurface;

// The texels of a light that cast its shadows.
struct KeyTexels {
    std::vector<std::size_t> places;
};

KeyTexels key_texels(const bake::CubemapLight& light, const bake::LightTexels& texels) {
    constexpr float kOfBrightest = 0.25F;
    std::vector<float> luminance(texels.size());
    for (std::size_t i = 0; i < luminance.size(); ++i) {
        // Rec. 709
        luminance[i] = 0.2126F * light[0][i] + 0.7152F * light[1][i] + 0.0722F * light[2][i];
    }
    const float brightest = *std::max_element(luminance.begin(), luminance.end());
    KeyTexels key;
    for (std::size_t i = 0; i < luminance.size(); ++i) {
        if (luminance[i] >= kOfBrightest * brightest) {
            key.places.push_back(texels.place_from_texel_index(i));
        }
    }
    return key;
}

float dot(std::span<const float> a, std::span<const float> b) {
    float sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

bool is_glossy(const scene::Bsdf& bsdf) {
    constexpr float kWidestAlpha = 0.25F;
    constexpr float kLeastExponent = 30;
    return bsdf.model() == scene::BsdfModel::ggx
               ? bsdf.alpha() <= kWidestAlpha
               : !bsdf.is_diffuse() && bsdf.exponent() >= kLeastExponent;
}

class ReferenceTracer {
  public:
    ReferenceTracer(const scene::Scene& scene,
                    const std::vector<ReferenceLight>& lights,
                    const ReferenceOptions& options)
        : options_(options),
          lights_(lights),
          camera_(scene.camera, options.width, options.height),
          caster_(scene),
          texels_(options.face_resolution, kSeed),
          direct_(caster_, texels_, 0) {
        for (const ReferenceLight& light : lights) {
            keys_.push_back(key_texels(light.texels, texels_));
        }
    }

    [[nodiscard]] BakeReference trace(const std::function<void(std::uint32_t)>& on_row) const {
        const std::size_t pixels = std::size_t{options_.width} * options_.height;
        BakeReference reference;
        reference.content.resize(pixels);
        reference.lit.resize(lights_.size());
        for (LitReference& lit : reference.lit) {
            lit.half.fill(std::vector<float>(3 * pixels));
            lit.key_open.resize(pixels);
        }
        tbb::enumerable_thread_specific<Scratch> scratches;
        for (std::uint32_t y = 0; y < options_.height; ++y) {
            tbb::parallel_for(std::uint32_t{0}, options_.width, [&](std::uint32_t x) {
                trace_pixel(x, y, scratches.local(), reference);
            });
            on_row(y + 1);
        }
        return reference;
    }

  private:
    static constexpr std::uint64_t kSeed = 0x5eed;

    struct Scratch {
        bake::DirectLight::Scratch direct;
        bake::TexelRow row;
        std::array<std::vector<float>, 3> response;  // of the pixel, by texel
        struct Key {
            std::uint32_t open = 0;
            std::uint32_t above = 0;
        };
        std::vector<Key> keys;  // by light
    };

    void trace_pixel(std::uint32_t x,
                     std::uint32_t y,
                     Scratch& scratch,
                     BakeReference& reference) const {
        const std::size_t pixel = std::size_t{y} * options_.width + x;
        PixelContent& content = reference.content[pixel];
        content = content_of(x, y);
        if (content == PixelContent::nothing) {
            return;
        }
        const std::uint32_t side =
            content == PixelContent::edge ? options_.edge_side : options_.side;
        scratch.keys.assign(lights_.size(), {});
        for (std::uint64_t half = 0; half < 2; ++half) {
            for (auto& plane : scratch.response) {
                plane.assign(texels_.size(), 0.0F);
            }
            for (std::uint32_t i = 0; i < side * side; ++i) {
                const std::uint32_t column = x * side + i % side;
                const std::uint32_t row = y * side + i / side;
                add_position(column, row, side, half, scratch);
            }
            const float each = 1 / static_cast<float>(side * side);
            for (std::size_t light = 0; light < lights_.size(); ++light) {
                for (std::size_t c = 0; c < 3; ++c) {
                    reference.lit[light].half[half][3 * pixel + c] =
                        each * dot(scratch.response[c], lights_[light].texels[c]);
                }
            }
        }
        for (std::size_t light = 0; light < lights_.size(); ++light) {
            const auto& [open, above] = scratch.keys[light];
            reference.lit[light].key_open[pixel] =
                above > 0 ? static_cast<float>(open) / static_cast<float>(above) : 0.0F;
        }
    }

    // By looking through it in many places, more finely than any bake.
    [[nodiscard]] PixelContent content_of(std::uint32_t x, std::uint32_t y) const {
        constexpr std::uint32_t kSide = 12;
        constexpr float kSameCosine = 0.95F;
        constexpr float kSamePlane = 2;  // footprints of the pixel
        std::optional<ReceiverSurface> first;
        std::uint32_t seen = 0;
        bool differ = false;
        for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
            const auto surface = look(x * kSide + i % kSide, y * kSide + i / kSide, kSide, 2);
            if (!surface) {
                continue;
            }
            ++seen;
            if (!first) {
                first = surface;
            }
            const Imath::V3f between = surface->point.position - first->point.position;
            const float off_plane = std::abs(between.dot(first->point.geometric_normal));
            differ =
                differ || surface->material != first->material ||
                surface->point.shading.normal.dot(first->point.shading.normal) < kSameCosine ||
                off_plane > kSamePlane * kSide * first->footprint;
        }
        if (!first) {
            return PixelContent::nothing;
        }
        if (differ || seen < kSide * kSide) {
            return PixelContent::edge;
        }
        return is_glossy(first->point.bsdf) ? PixelContent::gloss : PixelContent::matte;
    }

    // The surface at a place in cell (column, row) of `side` cells a pixel.
    [[nodiscard]] std::optional<ReceiverSurface> look(std::uint32_t column,
                                                      std::uint32_t row,
                                                      std::uint32_t side,
                                                      std::uint64_t half) const {
        const std::uint64_t bits = transport::mix_bits(transport::mix_bits(kSeed + half) ^
                                                       (std::uint64_t{row} << 32U) ^ column);
        const auto place = [side](std::uint32_t cell, float offset) {
            return (static_cast<float>(cell) + offset) / static_cast<float>(side);
        };
        const Imath::V3f direction =
            camera_.direction_from_pixel(place(column, transport::unit_float(bits)),
                                         place(row, transport::unit_float(bits << 32U)));
        const auto hit = caster_.closest_hit(camera_.eye(), direction);
        if (!hit) {
            return std::nullopt;
        }
        ReceiverSurface surface;
        surface.point = scene::surface_point(caster_.scene(), hit->mesh, hit->triangle,
                                             hit->barycentric, direction);
        surface.share = 1;
        surface.material = caster_.scene().meshes[hit->mesh].material;
        surface.origins.fill(bake::offset_origin(surface.point));
        surface.footprint = hit->distance * 2 * camera_.tan_half_height() /
                            static_cast<float>(camera_.height() * side);
        return surface;
    }

    void add_position(std::uint32_t column,
                      std::uint32_t row,
                      std::uint32_t side,
                      std::uint64_t half,
                      Scratch& scratch) const {
        const std::optional<ReceiverSurface> surface = look(column, row, side, half);
        if (!surface) {
            return;
        }
        const bake::Receiver point{.index = 0,
                                   .place = bake::sequence_place_from_pixel(column, row),
                                   .surfaces = {*surface}};
        const std::uint64_t seed = kSeed + 1 + half;
        direct_.compute(point, seed, scratch.row, scratch.direct);
        for (std::size_t c = 0; c < 3; ++c) {
            const bool grey = scratch.row.is_grey;
            const float factor = grey ? scratch.row.colour[static_cast<int>(c)] : 1.0F;
            const std::vector<float>& plane = scratch.row.plane[grey ? 0 : c];
            for (std::size_t i = 0; i < plane.size(); ++i) {
                scratch.response[c][i] += factor * plane[i];
            }
        }
        add_paths(*surface, point.place, side, seed, scratch);
        look_at_keys(surface->point, transport::mix_bits(seed ^ column) ^ row, scratch);
    }

    void add_paths(const ReceiverSurface& surface,
                   const bake::SequencePlace& place,
                   std::uint32_t side,
                   std::uint64_t seed,
                   Scratch& scratch) const {
        if (options_.bounces == 0) {
            return;
        }
        const std::uint32_t count = std::max(1U, options_.paths / (side * side));
        const bake::PathTracer tracer(caster_, options_.face_resolution, options_.bounces,
                                      count, seed);
        const bake::SurfacePaths paths = tracer.trace_surface(surface, place);
        const Imath::V3f factor =
            bake::reflectance(surface.point.bsdf) / static_cast<float>(paths.paths);
        auto key = paths.texels.begin();
        for (const bake::Escapes& escapes : paths.escapes) {
            for (std::uint32_t i = 0; i < escapes.count; ++i, ++key) {
                const std::size_t texel =
                    bake::texel_index_from_key(options_.face_resolution, *key);
                for (int c = 0; c < 3; ++c) {
                    scratch.response[static_cast<std::size_t>(c)][texel] +=
                        factor[c] * escapes.weight[c];
                }
            }
        }
    }

    // A few rays to the brightest texels of every light.
    void look_at_keys(const scene::SurfacePoint& point,
                      std::uint64_t key,
                      Scratch& scratch) const {
        constexpr std::uint64_t kRays = 4;
        const Imath::V3f origin = bake::offset_origin(point);
        for (std::size_t light = 0; light < keys_.size(); ++light) {
            const std::vector<std::size_t>& places = keys_[light].places;
            for (std::uint64_t i = 0; i < kRays; ++i) {
                const std::uint64_t bits = transport::mix_bits(key + light * kRays + i);
                const Imath::V3f direction = texels_.cube_point(
                    places[transport::mix_bits(bits) % places.size()],
                    transport::unit_float(bits), transport::unit_float(bits << 32U));
                if (point.is_above_surface(direction)) {
                    ++scratch.keys[light].above;
                    scratch.keys[light].open +=
                        caster_.is_occluded(origin, direction) ? 0U : 1U;
                }
            }
        }
    }

    ReferenceOptions options_;
    const std::vector<ReferenceLight>& lights_;
    scene::Camera camera_;
    bake::RayCaster caster_;
    bake::LightTexels texels_;
    bake::DirectLight direct_;
    std::vector<KeyTexels> keys_;
};

}  // namespace

std::vector<float> LitReference::picture() const {
    std::vector<float> mean(half[0].size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] = 0.5F * (half[0][i] + half[1][i]);
    }
    return mean;
}

BakeReference trace_reference(const scene::Scene& scene,
                              const std::vector<ReferenceLight>& lights,
                              const ReferenceOptions& options,
                              const std::function<void(std::uint32_t)>& on_row) {
    return ReferenceTracer(scene, lights, options).trace(on_row);
}

}  // namespace relume::lab
