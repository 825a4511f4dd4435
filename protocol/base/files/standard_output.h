// Results on standard output reach their reader, or the program says that they did not.
#pragma once

namespace relume::files {

// Flushes standard output. Throws FileError when anything written to it was lost, as on a full
// disk.
void flush_standard_output();

}  // namespace relume::files
