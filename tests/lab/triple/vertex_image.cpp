#include "tests/lab/triple/vertex_image.h"

#include "protocol/base/timing/stopwatch.h"
#include "protocol/brdf/factored_brdf.h"
#include "protocol/brdf/local_frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace relume::lab {

VertexImageMaker::VertexImageMaker(const SeenSurface& surface,
                                   std::shared_ptr<const served::Scene> scene,
                                   std::vector<Imath::V3f> colours)
    : surface_(surface),
      scene_(std::move(scene)),
      colours_(std::move(colours)),
      view_(scene_->make_view()),
      radiance_(scene_->transport().manifest().layout.clusters(),
                scene_->transport().manifest().block_basis,
                scene_->transport().tint()),
      terms_(scene_->transport().manifest().layout.clusters().clusters().front().terms) {
    look(scene_->beginning());
}

bool VertexImageMaker::look(const view::Look& look) {
    const bool has_changed = view_->look(look);
    eye_ = surface_.eye_in_frame(look);
    seen_ = surface_.seen_from(look);
    has_moved_ = true;
    return has_changed;
}

std::uint64_t VertexImageMaker::take(std::span<const float> sums) {
    radiance_.take(sums);
    return 0;
}

void VertexImageMaker::weigh_terms() {
    const transport::Surface& surface = *scene_->transport().surface();
    weights_.assign(seen_.size() * terms_, Imath::V3f(0));
    tbb::parallel_for(std::size_t{0}, seen_.size(), [&](std::size_t i) {
        const std::uint32_t vertex = seen_[i].vertex;
        const std::uint32_t material =
            scene_->transport().manifest().layout.clusters().clusters().front().material;
        const brdf::FactoredBrdf& brdf = surface.brdfs[material];
        Imath::V3f local =
            brdf::local_frame(seen_[i].normal)
                .local_from_world((eye_ - surface.mesh.positions[vertex]).normalized());
        local.z = std::max(local.z, brdf::kLeastViewCosine);
        std::vector<float> h(std::size_t{brdf.terms} * brdf.lobes);
        brdf.h.evaluate(local, h);
        for (std::uint32_t k = 0; k < terms_; ++k) {
            for (std::uint32_t lobe = 0; lobe < brdf.lobes; ++lobe) {
                weights_[i * terms_ + k] += colours_[lobe] * h[k * brdf.lobes + lobe];
            }
        }
    });
}

void VertexImageMaker::write(std::span<float> rgb) {
    const timing::Stopwatch watch;
    if (has_moved_) {
        weigh_terms();
        has_moved_ = false;
    }
    tbb::parallel_for(std::size_t{0}, seen_.size(), [&](std::size_t i) {
        // All clusters have as many terms.
        const float* terms =
            &radiance_
                 .values()[view::VertexRadiance::kFloatsPerTerm * terms_ * seen_[i].vertex];
        Imath::V3f sum(0);
        for (std::uint32_t k = 0; k < terms_; ++k) {
            const float* term = terms + view::VertexRadiance::kFloatsPerTerm * k;
            sum += weights_[i * terms_ + k] * Imath::V3f(term[0], term[1], term[2]);
        }
        for (int c = 0; c < 3; ++c) {
            rgb[3 * i + static_cast<std::size_t>(c)] = sum[c];
        }
    });
    write_seconds_ = watch.seconds();
}

}  // namespace relume::lab
