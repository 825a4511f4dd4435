#include "server/scene/scene.h"

namespace relume::served {

Scene::Scene(std::shared_ptr<const transport::Transport> transport)
    : projection_(basis::CubemapProjection::onto(transport->manifest().signal_basis)),
      operator_(std::make_shared<const engine::StoredOperator>(transport)),
      workspace_(std::make_shared<const engine::Workspace>(operator_)),
      view_(std::move(transport)) {}

}  // namespace relume::served
