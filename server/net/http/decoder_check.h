// Whether uploads can be decoded at all, known before the first one comes.
#pragma once

#include <filesystem>

namespace relume::net {

// Has the decoder (empty: relume-decode beside this program) decode an image of two texels.
// Throws std::runtime_error naming what fails: no such program, no right to run it, a sandbox
// that the system refuses.
void check_decoder(const std::filesystem::path& decoder);

}  // namespace relume::net
