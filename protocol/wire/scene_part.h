// A part of a scene that may be given another material, as clients are told of it.
#pragma once

#include <string>

namespace relume::wire {

struct ScenePart {
    std::string id;    // by which the section `finishes` calls it
    std::string name;  // of its material in the scene's file, for people

    friend bool operator==(const ScenePart&, const ScenePart&) = default;
};

}  // namespace relume::wire
