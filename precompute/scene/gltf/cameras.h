// The perspective cameras of a document's scene.
#pragma once

#include "precompute/scene/gltf/nodes.h"
#include "precompute/scene/imported_scene.h"

namespace relume::scene::gltf {

// Appends one camera for each node of the scene that has a perspective one; cameras of no such
// use, orthographic ones and those without a sound field of view are named in the report.
void import_cameras(const Document& document, const Nodes& nodes, ImportedScene& imported);

}  // namespace relume::scene::gltf
