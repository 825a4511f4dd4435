#include "tests/bench/programs.h"

namespace relume::bench {

std::filesystem::path server_program() {
    return RELUME_SERVER;
}
std::filesystem::path client_program() {
    return RELUME_CLIENT;
}

}  // namespace relume::bench
