// What assimp says while it reads. Its logger is one for the whole process, so only one import
// listens at a time; others wait.
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace relume::scene {

class ImportLog {
  public:
    ImportLog();
    ImportLog(const ImportLog&) = delete;
    ImportLog& operator=(const ImportLog&) = delete;
    ImportLog(ImportLog&&) = delete;
    ImportLog& operator=(ImportLog&&) = delete;
    ~ImportLog();

    // Warnings so far, without assimp's prefix; at most a hundred.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    std::unique_lock<std::mutex> turn_;
    std::vector<std::string> warnings_;
};

}  // namespace relume::scene
