// An environment, turned, as a lighting cubemap.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "protocol/light/prefiltered_environment.h"

#include <Imath/ImathQuat.h>
#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::light {

enum class Write : std::uint8_t { overwrite, accumulate };

// out(ω) = scale · environment(R⁻¹ ω), averaged over each texel: world direction = R · source
// direction. `rotation` is a unit quaternion. Always from the source, so that any number of
// turns leaves no trace. A constant map stays constant to rounding, and the energy of a sun of
// any size is kept within 2 % (tested) wherever in a texel it stands. Parallel over rows (TBB);
// the result does not depend on the number of threads. Throws std::invalid_argument unless out
// has the environment's face resolution.
void resample(const PrefilteredEnvironment& environment,
              const Imath::Quatf& rotation,
              const Imath::V3f& scale,
              Write write,
              LightCubemap& out);

}  // namespace relume::light
