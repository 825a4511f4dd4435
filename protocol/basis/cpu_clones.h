// RELUME_CPU_CLONES before a function compiles it for several generations of x86-64 and chooses
// by the processor when the program starts. For loops that the compiler vectorises by itself;
// with -ffp-contract=off all clones give the same bits.
#pragma once

// Sanitizers run before the choice can be made, and Clang names the generations differently.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RELUME_CPU_CLONES \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define RELUME_CPU_CLONES
#endif
