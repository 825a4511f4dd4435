// A folder with one small scene, "tiny", made once per test.
#pragma once

#include "server/net/library/scene_library.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"

#include <filesystem>

namespace relume::net {

class TinyScenes {
  public:
    TinyScenes() { test::write_tiny_transport(path() / "tiny.relume"); }
    [[nodiscard]] const std::filesystem::path& path() const { return scratch_.path(); }

  private:
    test::ScratchDirectory scratch_;
};

}  // namespace relume::net
