// A folder whose entries are followed while the server runs: which of them have come, changed
// or gone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace relume::net {

// Whether a change is followed only after two looks have seen the same, so that a file that is
// still being copied is not opened at every look.
enum class Patience : std::uint8_t { none, until_settled };

// Looks at names, sizes, times and identities; reads no file. Not thread-safe.
class FollowedFolder {
  public:
    // Whether an entry is one of those that are followed.
    using Concerns = bool (*)(const std::filesystem::directory_entry& entry);

    // Entries beyond the first `most`, in the order of their names, are not followed.
    FollowedFolder(Concerns concerns, std::size_t most) : concerns_(concerns), most_(most) {}

    struct Change {
        std::filesystem::path entry;
        bool is_gone = false;
    };
    // Looks, and returns the changes to be followed, in the order of names. Each change is
    // returned once. Throws std::runtime_error when the folder cannot be listed.
    [[nodiscard]] std::vector<Change> look(const std::filesystem::path& folder,
                                           Patience patience);
    // The number of entries at the last look, if they were more than are followed; else 0.
    [[nodiscard]] std::size_t too_many() const { return too_many_; }
    // Those that were there at the last look.
    [[nodiscard]] std::vector<std::filesystem::path> entries() const;

  private:
    struct Seen {
        std::uint64_t stamp = 0;  // 0: it is gone
        std::uint64_t followed_stamp = 0;
    };

    const Concerns concerns_;
    const std::size_t most_;
    std::map<std::filesystem::path, Seen> seen_;
    std::size_t too_many_ = 0;
};

// What an entry looks like from outside: a file by itself; a directory with all that is in it,
// down to a few levels and so many entries. 0 if there is none.
[[nodiscard]] std::uint64_t stamp_of(const std::filesystem::path& entry);

}  // namespace relume::net
