// Opening what must be a file of bytes: a named pipe, a device or a socket in its place is an
// error and not a wait without end.
#pragma once

#include "protocol/base/files/descriptor.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace relume::files {

// Whether the last part of a path may be a symbolic link.
enum class Links { follow, refuse };

// Opens for reading. Throws FileError naming the path when there is nothing, no permission, or
// anything but a regular file; never waits.
[[nodiscard]] Descriptor open_regular_file(const std::filesystem::path& path,
                                           Links links = Links::follow);

// For libraries that open files by name: throws as open_regular_file does.
void require_regular_file(const std::filesystem::path& path);

// The first bytes of the file, at most so many. Throws FileError.
[[nodiscard]] std::string read_beginning(const std::filesystem::path& path,
                                         std::size_t most_bytes,
                                         Links links = Links::follow);

// All bytes of the file. Throws FileError, also when it is longer than `max_bytes`.
[[nodiscard]] std::string read_regular_file(const std::filesystem::path& path,
                                            std::size_t max_bytes,
                                            Links links = Links::follow);

}  // namespace relume::files
