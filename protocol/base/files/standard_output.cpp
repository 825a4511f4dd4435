#include "protocol/base/files/standard_output.h"

#include "protocol/base/files/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace relume::files {

void flush_standard_output() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw FileError(fmt::format("standard output: cannot write: {}",
                                    errno != 0 ? std::strerror(errno) : "some of it is lost"));
    }
}

}  // namespace relume::files
