// Names by which rooms call the materials of a scene's file, which may be called anything.
#pragma once

#include <set>
#include <string>

namespace relume::text {

// Each ID once: of the name, with dashes for letters that names (names.h) have none of, and a
// number where that is taken. Depends on the order of calls alone.
class MaterialIds {
  public:
    [[nodiscard]] std::string next(const std::string& name);

  private:
    std::set<std::string> taken_;
};

}  // namespace relume::text
