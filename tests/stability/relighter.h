// What a method of the lab makes of one light after the other.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "tests/lab/methods/method.h"
#include "tests/stability/relit_image.h"

#include <memory>
#include <string>

namespace relume::stability {

struct Relit {
    light::LightCubemap light;  // as the method holds it
    RelitImage image;
};

// Not thread-safe.
class Relighter {
  public:
    // By the name that the lab knows the method by: "sh-5", "nwa-100-area".
    Relighter(const lab::LabScene& scene, const std::string& method);

    // One step.
    [[nodiscard]] Relit relit(const light::LightCubemap& light);

  private:
    std::shared_ptr<const served::Scene> scene_;
    std::unique_ptr<lab::Contestant> contestant_;
};

}  // namespace relume::stability
