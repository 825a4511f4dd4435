#include "server/scene/scene.h"

#include "server/view/image_view.h"

#include <utility>

namespace relume::served {

Scene::Scene(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)),
      projection_(basis::CubemapProjection::onto(transport_->manifest().signal_basis)),
      operator_(std::make_shared<const engine::StoredOperator>(transport_)),
      workspace_(std::make_shared<const engine::Workspace>(operator_)) {}

std::unique_ptr<view::View> Scene::make_view() const {
    return std::make_unique<view::ImageView>(transport_);
}

void Scene::write_image(std::span<const float> sums, std::span<float> rgb) const {
    view::write_image(*make_view(), sums, rgb);
}

}  // namespace relume::served
