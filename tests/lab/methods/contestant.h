// A method at work: it is given one light after another and makes one image of each.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "server/view/view.h"

#include <cstdint>
#include <span>

namespace relume::lab {

// One image's light, in the forms that methods start from.
struct ImageLight {
    const light::LightCubemap& radiance;
    std::span<const float> haar;  // its Haar coefficients, planar [3][N]
};

// What one step did.
struct Step {
    std::uint32_t applied = 0;      // coefficients whose columns were added
    std::uint32_t bands_reset = 0;  // bit b: band b began anew
    std::uint64_t bytes = 0;        // of the transport read
    std::uint64_t band_bytes = 0;   // of memory, so that bands can begin anew
    double stated_error = 0;        // relative L2 of the image, as the method states it
};

// What is asked for and what is shown, in the method's own basis.
struct LightingView {
    std::span<const float> target;         // L, planar [3][N]
    std::span<const float> approximation;  // L̃, planar [3][N]
    std::span<const std::uint8_t> bands;   // band of every coefficient, [N]
};

// Not thread-safe; begins with no light and a black image.
class Contestant {
  public:
    Contestant() = default;
    Contestant(const Contestant&) = delete;
    Contestant& operator=(const Contestant&) = delete;
    Contestant(Contestant&&) = delete;
    Contestant& operator=(Contestant&&) = delete;
    virtual ~Contestant() = default;

    // Brings the light into the method's basis. Not counted in the method's time.
    virtual void set_light(const ImageLight& light) = 0;
    // Where the next images are looked at from; at first where the scene's views begin. Not
    // counted either.
    virtual void look(const view::Look& look) = 0;
    // One image's worth of work towards the light last set: what is timed.
    virtual Step step() = 0;

    // The relit image after a step, interleaved RGB, 3·width·height values.
    virtual void write_image(std::span<float> rgb) = 0;
    // Valid until the next call of set_light or step.
    [[nodiscard]] virtual LightingView lighting() const = 0;
    // L̃ as radiance, in whatever basis it is held; `out` is reset to the scene's resolution.
    virtual void write_radiance(light::LightCubemap& out) const = 0;
};

}  // namespace relume::lab
