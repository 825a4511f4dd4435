// Linked into every program of preset tsan: oneTBB runs all loops on the thread that asks.
//
// Debian's oneTBB is not instrumented, so ThreadSanitizer does not see how it hands tasks from
// one thread to another and takes every hand-over for a race. What is left to it is all that
// our own threads do: connections, workers, rooms, writers. That the bodies of parallel loops
// write to different places is held by tests that compare results across thread counts.
#include <tbb/global_control.h>

namespace {

const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace
