// What a directory looks like from outside: enough to notice that something in it has changed.
#pragma once

#include <cstdint>
#include <filesystem>

namespace relume::net {

// Of the names, sizes, times and identities of all entries of a directory and the directories
// in it, down to a few levels and so many entries; reads no file. 0 if there is none.
[[nodiscard]] std::uint64_t folder_stamp(const std::filesystem::path& directory);

}  // namespace relume::net
