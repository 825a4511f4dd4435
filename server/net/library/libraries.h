// What states of rooms name: maps and materials.
#pragma once

#include "server/net/library/environment_library.h"
#include "server/net/library/material_library.h"

namespace relume::net {

struct Libraries {
    const EnvironmentLibrary& environments;
    const MaterialLibrary& materials;
};

}  // namespace relume::net
