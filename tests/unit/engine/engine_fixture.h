// A small scene in a scratch folder.
#pragma once

#include "server/scene/scene.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"

#include <memory>

namespace relume::engine {

class TinyScene {
  public:
    explicit TinyScene(const test::TinyTransportOptions& options = {}) {
        test::write_tiny_transport(scratch_.path() / "tiny.relume", options);
        scene_ = std::make_shared<const served::Scene>(
            transport::Transport::open(scratch_.path() / "tiny.relume"));
    }

    [[nodiscard]] const std::shared_ptr<const served::Scene>& scene() const { return scene_; }
    [[nodiscard]] const transport::Transport& transport() const { return scene_->transport(); }

  private:
    test::ScratchDirectory scratch_;
    std::shared_ptr<const served::Scene> scene_;
};

}  // namespace relume::engine
