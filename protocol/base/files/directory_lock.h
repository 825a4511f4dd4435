// A directory that one process at a time writes into.
#pragma once

#include "protocol/base/files/descriptor.h"

#include <filesystem>

namespace relume::files {

// Held until it is destroyed or the process ends, however it ends; leaves nothing behind.
class DirectoryLock {
  public:
    // Throws FileError when somebody else holds it or the directory cannot be opened. Where the
    // file system knows no locks, nothing is held.
    explicit DirectoryLock(const std::filesystem::path& directory);

  private:
    Descriptor directory_;
};

}  // namespace relume::files
