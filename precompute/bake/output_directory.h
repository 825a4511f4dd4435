// Where a bake's transport will lie, settled before anything is computed: a name that servers
// find, a directory that is ours alone and takes what will be written.
#pragma once

#include "precompute/bake/base/field_request.h"
#include "precompute/bake/base/parameters.h"
#include "protocol/base/files/directory_lock.h"

#include <filesystem>
#include <optional>
#include <string>

namespace relume::bake {

// The directory that `-o text` means: `mine` is completed to `mine.relume`. Throws
// program::UsageError for a name that is empty, ends otherwise, names a directory to put it in,
// or that no server would serve (protocol/README.md §3).
[[nodiscard]] std::filesystem::path transport_directory_from_option(const std::string& text);

// What any bake of these parameters writes at least, whatever the scene: tables and indices.
struct LeastBytes {
    std::uint64_t total = 0;
    std::uint64_t longest_file = 0;
};
[[nodiscard]] LeastBytes least_bytes(const BakeParameters& parameters,
                                     const FieldRequest& fields = {});

// The directory, made and held while this lives. What was made and stayed empty is removed with
// it, so that a scene that cannot be read leaves no trace.
class OutputDirectory {
  public:
    // Throws files::FileError when it cannot be made, another bake writes into it, something
    // that is no file has the name of one to come, or the room does not suffice.
    OutputDirectory(std::filesystem::path path,
                    const BakeParameters& parameters,
                    const FieldRequest& fields = {});
    OutputDirectory(const OutputDirectory&) = delete;
    OutputDirectory& operator=(const OutputDirectory&) = delete;
    OutputDirectory(OutputDirectory&&) = delete;
    OutputDirectory& operator=(OutputDirectory&&) = delete;
    ~OutputDirectory();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::optional<files::DirectoryLock> lock_;
};

}  // namespace relume::bake
