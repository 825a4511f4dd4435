// The operator's folder of maps, followed into the library of environments.
#pragma once

#include "protocol/light/environment_import.h"
#include "server/net/library/environment_library.h"
#include "server/net/library/followed_folder.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace relume::net {

// Every .hdr and .exr of the folder is an environment by the name of its file. Not thread-safe;
// the library is.
class EnvironmentFolder {
  public:
    static constexpr std::size_t kMaxFiles = 4096;

    // `centre` is where the centres of all its maps look.
    EnvironmentFolder(EnvironmentLibrary& library,
                      std::filesystem::path folder,
                      light::MapCentre centre);

    // Offers what lies in the folder now, and takes back what is gone; a file that has changed
    // is an environment of a new version. Reads no more than headers. What cannot be used is
    // named in the log, once, and left out or offered on as it was. Throws std::runtime_error
    // if the folder cannot be read.
    void refresh(Patience patience = Patience::none);

  private:
    void follow(const FollowedFolder::Change& change);
    void add(const std::filesystem::path& file);

    EnvironmentLibrary& library_;
    const std::filesystem::path folder_;
    const light::MapCentre centre_;
    FollowedFolder followed_;
    std::map<std::string, std::filesystem::path> offered_;  // by name
};

}  // namespace relume::net
