// Files written whole or not at all: temporary name, sync, rename, sync of the folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <span>

namespace relume::files {

using Bytes = std::span<const std::byte>;

// Writes the parts one after another. What an earlier run left under the temporary name is in
// nobody's way. Throws FileError naming the file and the system's reason; the old file, if any,
// is then still there.
void write_file_atomically(const std::filesystem::path& path, std::span<const Bytes> parts);
inline void write_file_atomically(const std::filesystem::path& path,
                                  std::initializer_list<Bytes> parts) {
    write_file_atomically(path, std::span(parts.begin(), parts.size()));
}

template <typename T>
[[nodiscard]] Bytes bytes_of(const T& contiguous) {
    return std::as_bytes(std::span(contiguous));
}

}  // namespace relume::files
