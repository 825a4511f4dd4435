// A ball under a light that is frozen, whose material is edited by one curve, and what its BRDF
// reflects by a plain integral.
#pragma once

#include "protocol/curve/curve_brdf.h"
#include "protocol/light/light_cubemap.h"
#include "server/engine/session.h"
#include "server/scene/scene.h"
#include "tests/stability/relit_image.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <memory>
#include <string>

namespace relume::stability {

struct BallOptions {
    std::string model = "ggx:f0=1,alpha=0.2";  // as --model of the bake
    std::string curve = "distribution";
    std::uint32_t side = 32;  // of the image, in pixels
    std::uint32_t samples = 64;
};

// A ball of radius 1 that fills most of a square image, black but for its BRDF and black behind
// it. Not thread-safe.
class BakedBall {
  public:
    BakedBall(const light::LightCubemap& light, const BallOptions& options = {});

    [[nodiscard]] const curve::CurveBrdf& brdf() const { return brdf_; }
    [[nodiscard]] std::size_t edited() const { return edited_; }
    [[nodiscard]] const curve::Curve& baked() const { return brdf_.curves()[edited_].curve; }
    [[nodiscard]] const std::shared_ptr<const served::Scene>& scene() const { return scene_; }

    // Of all columns.
    [[nodiscard]] RelitImage image(const curve::Curve& curve) const;

    // What a room shows so many images after the curve was `from` at rest and became `to`, each
    // image with so many columns more, by BI; and which curve that is.
    struct Followed {
        RelitImage image;
        curve::Curve curve;
        bool is_exact = false;
    };
    [[nodiscard]] Followed follow(const curve::Curve& from,
                                  const curve::Curve& to,
                                  std::uint32_t columns,
                                  std::uint32_t images = 1) const;

    // By the BRDF with this curve: a sum over half vectors, dense where highlights are narrow,
    // at four places of every pixel, and 36 at the rim.
    [[nodiscard]] RelitImage reflected(const curve::Curve& curve) const;
    // The cosine between the viewer and the normal at the middle of a pixel; 0 beside the ball.
    [[nodiscard]] double cosine_to_viewer(std::uint32_t x, std::uint32_t y) const;

  private:
    light::LightCubemap light_;
    curve::CurveBrdf brdf_;
    std::size_t edited_ = 0;
    std::uint32_t side_;
    std::shared_ptr<const served::Scene> scene_;
};

}  // namespace relume::stability
