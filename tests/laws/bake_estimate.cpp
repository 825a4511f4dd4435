#include "tests/laws/bake_estimate.h"

#include "precompute/bake/bake.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/bake/rows/row_baker.h"
#include "protocol/transport/transport.h"
#include "tests/support/sample_moments.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace relume::test {

using Imath::V3d;

bake::BakeParameters unbiased_parameters() {
    bake::BakeParameters parameters;
    parameters.width = 24;
    parameters.height = 24;
    parameters.face_resolution = 16;
    parameters.bounces = 0;
    parameters.samples = 256;
    parameters.pixel_samples = 1;
    parameters.pool_radius = 0;
    parameters.shrinkage = 0;
    return parameters;
}

LinearImage relit_from_rows(const scene::Scene& scene,
                            const bake::BakeParameters& parameters,
                            const std::vector<Imath::V3f>& light) {
    const bake::RayCaster caster(scene);
    const bake::LightTexels texels(parameters.face_resolution, parameters.seed);
    const bake::PixelReceivers receivers(caster, parameters);
    const bake::PathTracer tracer(caster, parameters);
    const bake::RowBaker rows(caster, texels, parameters);
    const std::size_t columns = rows.projection().basis().coefficient_count();
    std::array<std::vector<float>, 3> coefficients;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> plane;
        for (const Imath::V3f& texel : light)
            plane.push_back(texel[static_cast<int>(c)]);
        coefficients[c].resize(columns);
        rows.projection().project_radiance(plane, coefficients[c]);
    }
    struct Scratch {
        bake::RowBaker::Scratch baking;
        std::vector<bake::CoefficientRow> rows;
    };
    tbb::enumerable_thread_specific<Scratch> scratches;
    const std::size_t pixels = receivers.receiver_count();
    LinearImage image{parameters.width, parameters.height,
                      std::vector<V3d>(pixels, V3d(0, 0, 0))};
    tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t p) {
        Scratch& scratch = scratches.local();
        rows.bake(tracer.trace(receivers.look(p)), nullptr, scratch.rows, scratch.baking);
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t j = 0; j < columns; ++j)
                image.pixels[p][static_cast<int>(c)] +=
                    double{scratch.rows.front().rgb[c][j]} * coefficients[c][j];
        }
    });
    return image;
}

LinearImage relit_from_stored(const scene::Scene& scene,
                              const bake::BakeParameters& parameters,
                              const std::vector<Imath::V3f>& light,
                              const std::filesystem::path& directory) {
    bake::bake(scene, parameters, directory);
    return dense_product(*transport::Transport::open(directory), light);
}

Estimate estimate_from_rows(const scene::Scene& scene,
                            bake::BakeParameters parameters,
                            const std::vector<Imath::V3f>& light,
                            std::uint32_t seeds) {
    const std::size_t pixels = std::size_t{parameters.width} * parameters.height;
    std::vector<SampleMoments<V3d>> moments(pixels, SampleMoments<V3d>(V3d(0, 0, 0)));
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        parameters.seed = seed + 1;
        const LinearImage image = relit_from_rows(scene, parameters, light);
        for (std::size_t p = 0; p < pixels; ++p)
            moments[p].add(image.pixels[p]);
    }
    Estimate estimate{.mean = {}, .variance = {}, .seeds = seeds};
    for (const SampleMoments<V3d>& pixel : moments) {
        estimate.mean.push_back(pixel.mean());
        estimate.variance.push_back(pixel.variance_of_mean());
    }
    return estimate;
}

double relative_l2(const std::vector<V3d>& image, const std::vector<V3d>& truth) {
    double error = 0;
    double energy = 0;
    for (std::size_t p = 0; p < truth.size(); ++p) {
        error += (image[p] - truth[p]).length2();
        energy += truth[p].length2();
    }
    return std::sqrt(error / energy);
}

}  // namespace relume::test
