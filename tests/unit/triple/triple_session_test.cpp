#include "server/triple/triple_session.h"

#include "protocol/basis/haar.h"
#include "protocol/transport/error.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace relume::triple {
namespace {

constexpr std::uint32_t n = 16;
constexpr std::uint32_t kVertices = 3000;
constexpr std::uint32_t kPerBlock = 250;
constexpr std::uint32_t kMaterials = 3;

Imath::V3f random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Imath::V3f(normal(random), normal(random), normal(random)).normalized();
}

transport::SurfaceMesh ball() {
    transport::SurfaceMesh mesh;
    std::mt19937 random(1);
    for (std::uint32_t i = 0; i < kVertices; ++i) {
        mesh.normals.push_back(random_direction(random));
        mesh.positions.push_back(mesh.normals.back());
    }
    return mesh;
}

std::vector<std::uint32_t> materials_in_turn() {
    std::vector<std::uint32_t> materials(kVertices);
    for (std::uint32_t i = 0; i < kVertices; ++i) {
        materials[i] = i % kMaterials;
    }
    return materials;
}

std::vector<std::vector<std::uint64_t>> random_bits() {
    std::vector<std::vector<std::uint64_t>> bits;
    for (unsigned i = 0; i < kVertices; ++i) {
        // A few seeds do: a point's bits take long to draw.
        bits.push_back(i < 40 ? tripling::bits_of(tripling::random_visibility(n, i))
                              : bits[i % 40]);
    }
    return bits;
}

std::vector<std::byte> field_of(const std::vector<std::vector<std::uint64_t>>& bits,
                                std::uint32_t vertices) {
    transport::VisibilityFieldBuilder builder(n, (vertices + kPerBlock - 1) / kPerBlock);
    for (std::uint32_t first = 0; first < vertices; first += kPerBlock) {
        std::vector<std::uint64_t> block;
        for (std::uint32_t i = first; i < std::min(first + kPerBlock, vertices); ++i) {
            block.insert(block.end(), bits[i].begin(), bits[i].end());
        }
        builder.set_block(first / kPerBlock, block);
    }
    return builder.bytes();
}

// Entries of positive functions, with all of their wavelets.
tripling::MaterialField random_field(std::uint32_t normals,
                                     std::uint32_t reflections,
                                     std::size_t lobes,
                                     unsigned seed,
                                     std::uint32_t resolution = n) {
    tripling::MaterialField field;
    field.name = "random";
    field.normals = tripling::DirectionGrid(normals);
    field.reflections = tripling::DirectionGrid(reflections);
    for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
        field.colours.emplace_back(1.0F, 0.5F, 0.25F);
        tripling::WaveletStore& store = field.lobes.emplace_back(resolution);
        for (std::size_t entry = 0; entry < field.entry_count(); ++entry) {
            auto texels = tripling::random_cubemap(resolution, ++seed);
            std::transform(texels.begin(), texels.end(), texels.begin(),
                           [](float value) { return std::abs(value); });
            const auto c = tripling::coefficients_of(resolution, texels);
            store.append(tripling::SparseWavelets(
                tripling::nonzero_squares(resolution, c).with_ancestors(), c));
        }
    }
    return field;
}

using Light = std::array<std::vector<float>, 3>;

Light random_light(unsigned seed) {
    Light light;
    for (unsigned c = 0; c < light.size(); ++c) {
        light[c] = tripling::random_cubemap(n, 100 * seed + c);
        std::transform(light[c].begin(), light[c].end(), light[c].begin(),
                       [](float value) { return std::exp(2 * value); });
    }
    return light;
}

struct Scene {
    transport::SurfaceMesh mesh = ball();
    std::vector<std::vector<std::uint64_t>> bits = random_bits();
    std::vector<std::byte> bytes = field_of(bits, kVertices);
    std::shared_ptr<const LitSurface> surface = std::make_shared<LitSurface>(
        mesh, materials_in_turn(), transport::VisibilityField(bytes, "visibility.bin"));
    tripling::MaterialField diffuse_field = random_field(3, 1, 1, 1000);
    tripling::MaterialField glossy_field = random_field(2, 3, 2, 5000);
    std::shared_ptr<const TexelMaterial> diffuse =
        std::make_shared<TexelMaterial>(diffuse_field);
    std::shared_ptr<const TexelMaterial> glossy = std::make_shared<TexelMaterial>(glossy_field);
    std::vector<std::uint32_t> all;

    Scene() : all(kVertices) { std::iota(all.begin(), all.end(), 0U); }

    [[nodiscard]] TripleSession session() const {
        TripleSession session(surface);
        session.set_material(0, diffuse);
        session.set_material(1, glossy);
        session.set_material(2, diffuse);
        return session;
    }
};

const Scene& scene() {
    static const Scene made;
    return made;
}

void light(TripleSession& session, const Light& light) {
    session.set_light({light[0], light[1], light[2]});
}

void finish(TripleSession& session) {
    while (session.advance_by(501)) {
    }
}

std::vector<Radiance> copy_of(const TripleSession& session) {
    return {session.radiance().begin(), session.radiance().end()};
}

// Light times visibility times material, texel by texel from the field's own wavelets.
Radiance brute_force(const tripling::MaterialField& field,
                     std::size_t vertex,
                     const Imath::V3f& eye,
                     const Light& light) {
    const Imath::V3f normal = scene().mesh.normals[vertex];
    const Imath::V3f viewer = (eye - scene().mesh.positions[vertex]).normalized();
    const auto place =
        tripling::place_in_field(field, normal, tripling::mirrored(viewer, normal));
    Radiance sum{};
    for (std::size_t lobe = 0; lobe < field.lobes.size(); ++lobe) {
        std::vector<double> mixed(basis::texel_count(n), 0);
        for (std::size_t i = 0; i < place.count; ++i) {
            const auto view = field.lobes[lobe].view(place.entries[i].index);
            std::vector<float> texels(basis::texel_count(n), 0.0F);
            for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
                texels[face * n * n] = view.scaling[face];
                for (std::uint32_t s = view.first[face]; s < view.first[face + 1]; ++s) {
                    for (std::size_t m = 0; m < 3; ++m) {
                        texels[face * n * n +
                               tripling::coefficient_from_wavelet(
                                   n, tripling::square_from_index(view.squares[s]),
                                   tripling::kWaveletTypes[m])] = view.values[s][m + 1];
                    }
                }
            }
            basis::haar_inverse_cubemap(n, texels);
            for (std::size_t t = 0; t < texels.size(); ++t) {
                mixed[t] += double{place.entries[i].weight} * double{texels[t]};
            }
        }
        for (std::size_t c = 0; c < sum.size(); ++c) {
            double of_lobe = 0;
            for (std::size_t t = 0; t < mixed.size(); ++t) {
                if (transport::is_open(scene().bits[vertex], t)) {
                    of_lobe += mixed[t] * double{light[c][t]};
                }
            }
            sum[c] += static_cast<float>(of_lobe) * field.colours[lobe][static_cast<int>(c)];
        }
    }
    return sum;
}

TEST(TripleSession, IsTheProductOfLightVisibilityAndMaterial) {
    TripleSession session = scene().session();
    const Light lit = random_light(1);
    const Imath::V3f eye(3, 1, 2);
    light(session, lit);
    session.set_view(eye, scene().all);
    EXPECT_FALSE(session.exact());
    finish(session);
    EXPECT_TRUE(session.exact());
    EXPECT_EQ(session.stated_error(), 0);
    for (std::size_t vertex = 0; vertex < kVertices; vertex += 97) {
        const auto& field =
            vertex % kMaterials == 1 ? scene().glossy_field : scene().diffuse_field;
        const Radiance expected = brute_force(field, vertex, eye, lit);
        for (std::size_t c = 0; c < expected.size(); ++c) {
            EXPECT_NEAR(session.radiance()[vertex][c], expected[c],
                        2 * TexelMaterial::kLeftOff * expected[c] + 1e-3 * expected[c])
                << "vertex " << vertex;
        }
    }
}

// Whatever was edited before, in whatever slices and on any number of threads.
TEST(TripleSession, ExactImagesDependOnTheirStateAlone) {
    const Light final_light = random_light(2);
    const Imath::V3f eye(0, 0, 4);
    TripleSession straight = scene().session();
    light(straight, final_light);
    straight.set_view(eye, scene().all);
    finish(straight);

    TripleSession edited = scene().session();
    std::mt19937 random(9);
    for (unsigned edit = 0; edit < 12; ++edit) {
        light(edited, random_light(edit));
        edited.set_view(random_direction(random) * 3,
                        std::span(scene().all).first(200 * (edit + 1)));
        edited.set_material(edit % kMaterials,
                            edit % 2 == 0 ? scene().glossy : scene().diffuse);
        edited.advance_by(77 * edit);
    }
    edited.set_material(0, scene().diffuse);
    edited.set_material(1, scene().glossy);
    edited.set_material(2, scene().diffuse);
    edited.set_view(eye, scene().all);
    light(edited, final_light);
    tbb::task_arena(1).execute([&] { finish(edited); });
    EXPECT_TRUE(edited.exact());
    EXPECT_EQ(copy_of(edited), copy_of(straight));
}

TEST(TripleSession, AMaterialThereAndBackGivesTheSameBits) {
    TripleSession session = scene().session();
    light(session, random_light(3));
    session.set_view({0, 2, 2}, scene().all);
    finish(session);
    const auto before = copy_of(session);
    session.set_material(0, scene().glossy);
    finish(session);
    EXPECT_NE(copy_of(session), before);
    session.set_material(0, scene().diffuse);
    EXPECT_EQ(session.stale_count(), kVertices / kMaterials) << "others need nothing";
    finish(session);
    EXPECT_EQ(copy_of(session), before);
}

TEST(TripleSession, AnEditMakesNewWhatDependsOnIt) {
    TripleSession session = scene().session();
    light(session, random_light(4));
    session.set_view({0, 2, 2}, std::span(scene().all).first(600));
    finish(session);
    // What does not depend on the view stays.
    session.set_view({0, 3, 2}, std::span(scene().all).first(600));
    EXPECT_EQ(session.stale_count(), 200U);
    finish(session);
    // What was never seen is made when it is.
    session.set_view({0, 3, 2}, std::span(scene().all).first(900));
    EXPECT_EQ(session.stale_count(), 300U);
    finish(session);
    light(session, random_light(5));
    EXPECT_EQ(session.stale_count(), 900U);
    EXPECT_FALSE(session.exact());
    EXPECT_EQ(session.stated_error(), 1) << "nothing is known of the new light";
}

TEST(TripleSession, TakesTimeAndEnds) {
    TripleSession session = scene().session();
    light(session, random_light(6));
    session.set_view({1, 2, 2}, scene().all);
    EXPECT_TRUE(session.advance(0)) << "at least one run";
    while (!session.exact()) {
        session.advance(1);
    }
    EXPECT_FALSE(session.advance(1));
}

// Of 200 images of edits that are followed in part, 95 % state their error within 20 %.
TEST(TripleSession, StatesItsErrorToAFifth) {
    std::mt19937 random(11);
    TripleSession session = scene().session();
    light(session, random_light(0));
    session.set_view({0, 0, 3}, scene().all);
    finish(session);
    int images = 0;
    int right = 0;
    for (unsigned edit = 1; edit <= 50; ++edit) {
        light(session, random_light(edit));
        session.set_view(random_direction(random) * 3, scene().all);
        TripleSession truth = session;
        finish(truth);
        for (int slice = 0; slice < 4; ++slice) {
            session.advance_by(500);
            double difference = 0;
            double norm = 0;
            for (std::size_t i = 0; i < kVertices; ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const double is = truth.radiance()[i][c];
                    difference += std::pow(session.radiance()[i][c] - is, 2);
                    norm += is * is;
                }
            }
            const double error = std::sqrt(difference / norm);
            ++images;
            right += std::abs(session.stated_error() - error) <= 0.2 * error ? 1 : 0;
        }
    }
    EXPECT_GE(right, 95 * images / 100) << "of " << images;
}

// Between two steps of a family the tables are mixed; at either end it is that step, bit for
// bit.
TEST(TripleSession, FinishesBetweenTwoStepsAreTheirMixture) {
    const auto rendered = [&](Finish finish) {
        TripleSession session = scene().session();
        light(session, random_light(3));
        session.set_view({1, 2, 2}, scene().all);
        for (std::uint32_t material = 0; material < kMaterials; ++material) {
            session.set_material(material, finish);
        }
        while (session.advance_by(kVertices)) {
        }
        return std::vector(session.radiance().begin(), session.radiance().end());
    };
    const auto other = std::make_shared<const TexelMaterial>(random_field(2, 3, 2, 77));
    const auto first = rendered(scene().glossy);
    const auto second = rendered({other, scene().glossy->colours()});
    EXPECT_EQ(rendered({scene().glossy, other, 0}), first);
    const auto between = rendered({scene().glossy, other, 0.25F});
    for (std::size_t v = 0; v < first.size(); ++v) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(between[v][c], 0.75F * first[v][c] + 0.25F * second[v][c],
                        1e-5F * (1 + std::abs(first[v][c]) + std::abs(second[v][c])));
        }
    }
}

template <typename Call>
void expect_fault(const Call& call, const std::string& named) {
    try {
        call();
        ADD_FAILURE() << "accepted, expected: " << named;
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
}

TEST(TripleSession, RefusesWhatDoesNotFit) {
    TripleSession session = scene().session();
    const auto other = std::make_shared<const TexelMaterial>(random_field(1, 1, 1, 1, 8));
    expect_fault([&] { session.set_material(0, other); }, "face resolution 8, expected 16");
    expect_fault([&] { static_cast<void>(Finish(nullptr)); }, "no material");
    expect_fault([&] { session.set_material(3, scene().diffuse); }, "material 3");
    expect_fault([&] { static_cast<void>(Finish(scene().glossy, std::vector{Imath::V3f(1)})); },
                 "1 colours, expected 2");
    expect_fault([&] { static_cast<void>(Finish(scene().glossy, scene().diffuse, 0.5F)); },
                 "two steps of one family");
    const std::vector<std::uint32_t> beyond{kVertices};
    expect_fault([&] { session.set_view({0, 0, 1}, beyond); }, "vertex 3000");
    const std::vector<float> few(5);
    expect_fault([&] { session.set_light({few, few, few}); }, "light of 5 texels");
}

TEST(LitSurface, RefusesFieldsOfOtherSurfaces) {
    const auto bytes = field_of(scene().bits, kVertices - 1);
    const transport::VisibilityField fewer(bytes, "visibility.bin");
    const transport::VisibilityField right(scene().bytes, "visibility.bin");
    expect_fault([&] { LitSurface(scene().mesh, materials_in_turn(), fewer); },
                 "points of the visibility: found 2999, expected 3000");
    expect_fault(
        [&] {
            LitSurface(scene().mesh, {1, 2}, right);
        },
        "materials of vertices: found 2");
    transport::SurfaceMesh without = scene().mesh;
    without.normals.clear();
    expect_fault([&] { LitSurface(without, materials_in_turn(), right); },
                 "normals: found 0, expected 3000");
}

TEST(LitSurface, HasReflectionsOfAnEyeAtTheVertex) {
    const Imath::V3f there = scene().mesh.positions[5];
    EXPECT_EQ(scene().surface->reflection(5, there), scene().surface->normal(5));
}

}  // namespace
}  // namespace relume::triple
