// Whether files that are to be written later will find their place.
#pragma once

#include <cstdint>
#include <filesystem>

namespace relume::files {

// For every program that writes files: passing the process's limit on file sizes becomes an
// error of the write, as a full disk is, and not the end of the process.
void make_file_size_limit_an_error();

// Throws FileError unless, as things stand, files of `total_bytes` together, the longest of
// `longest_bytes`, can be made in the directory: permission, a file system that takes writes,
// free space, the process's limit on file sizes. Tries it with a small file that it removes.
void require_room(const std::filesystem::path& directory,
                  std::uint64_t total_bytes,
                  std::uint64_t longest_bytes);

// Throws FileError where write_file_atomically could not put its file because something that is
// no file, as a directory, has the name.
void require_replaceable(const std::filesystem::path& path);

}  // namespace relume::files
