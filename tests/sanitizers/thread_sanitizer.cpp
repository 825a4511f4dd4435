// Linked into every program of preset tsan: Debian's libraries are not instrumented, so
// ThreadSanitizer does not see how they hand work from one thread to another and takes every
// hand-over for a race. What is left to it is all that our own threads do: connections,
// workers, rooms, writers.
#include <tbb/global_control.h>

namespace {

// oneTBB runs all loops on the thread that asks. That the bodies of parallel loops write to
// different places is held by tests that compare results across thread counts.
const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace

// The hooks' names are ThreadSanitizer's.
extern "C" const char* __tsan_default_suppressions();  // NOLINT
extern "C" const char* __tsan_default_options();       // NOLINT

extern "C" const char* __tsan_default_suppressions() {  // NOLINT
    return "race:libOpenEXR\n"
           "race:libIlmThread\n"
           "race:libOpenImageIO\n"
           "race:libembree3\n"
           "race:libtbb\n";
}

// relume-decode starts its threads in a fork, beside the sanitizer's own thread, and ends without
// waiting for OpenEXR's.
extern "C" const char* __tsan_default_options() {  // NOLINT
    return "die_after_fork=0:report_thread_leaks=0";
}
