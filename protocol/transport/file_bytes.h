// A whole file, read into memory of its own, which nobody writes to afterwards.
//
// Mapping the file itself would cost no less memory once it has been read, and would give
// whoever may write to it the process: a file cut short is SIGBUS, and a rewritten one makes
// lengths that were checked once into nonsense.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace relume::transport {

class FileBytes {
  public:
    // Throws TransportError when the file is missing, not a regular file or cannot be read.
    explicit FileBytes(const std::filesystem::path& path);
    FileBytes(FileBytes&& other) noexcept;
    FileBytes& operator=(FileBytes&& other) noexcept;
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;
    ~FileBytes();

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::span<const std::byte> bytes_;
};

}  // namespace relume::transport
