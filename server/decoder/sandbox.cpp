#include "server/decoder/sandbox.h"

#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

namespace relume::decoder {
namespace {

// Sanitizers map terabytes of shadow, so an address space cannot be bounded under them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanBoundAddressSpace = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kCanBoundAddressSpace = false;
#else
constexpr bool kCanBoundAddressSpace = true;
#endif
#else
constexpr bool kCanBoundAddressSpace = true;
#endif

void require(bool holds, int error, const char* what) {
    if (!holds) {
        throw std::system_error(error, std::generic_category(), what);
    }
}

void set_limit(__rlimit_resource resource, rlim_t value, const char* what) {
    const rlimit limit{value, value};
    require(setrlimit(resource, &limit) == 0, errno, what);
}

class SyscallFilter {
  public:
    SyscallFilter() : context_(seccomp_init(SCMP_ACT_KILL_PROCESS), seccomp_release) {
        require(context_ != nullptr, ENOMEM, "seccomp_init");
        check(seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_TSYNC, 1),
              "seccomp thread sync");
    }

    template <typename... Conditions>
    void allow(int syscall, Conditions... conditions) {
        check(seccomp_rule_add(context_.get(), SCMP_ACT_ALLOW, syscall, sizeof...(conditions),
                               conditions...),
              "seccomp_rule_add");
    }
    void load() { check(seccomp_load(context_.get()), "seccomp_load"); }

  private:
    static void check(int result, const char* what) { require(result == 0, -result, what); }

    std::unique_ptr<void, decltype(&seccomp_release)> context_;
};

scmp_arg_cmp argument(unsigned index, scmp_compare how, scmp_datum_t a, scmp_datum_t b = 0) {
    return {index, how, a, b};
}

void load_filter() {
    constexpr scmp_datum_t kExec = PROT_EXEC;
    SyscallFilter filter;
    filter.allow(SCMP_SYS(read), argument(0, SCMP_CMP_EQ, 0));
    filter.allow(SCMP_SYS(write), argument(0, SCMP_CMP_EQ, 1));
    filter.allow(SCMP_SYS(write), argument(0, SCMP_CMP_EQ, 2));
    // Memory, but none that can be executed.
    filter.allow(SCMP_SYS(mmap), argument(2, SCMP_CMP_MASKED_EQ, kExec, 0));
    filter.allow(SCMP_SYS(mprotect), argument(2, SCMP_CMP_MASKED_EQ, kExec, 0));
    for (const int syscall :
         {SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(brk), SCMP_SYS(futex),
          SCMP_SYS(sched_yield), SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday),
          SCMP_SYS(getrandom), SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(rt_sigprocmask),
          SCMP_SYS(rt_sigreturn), SCMP_SYS(exit), SCMP_SYS(exit_group),
          // Harmless, and AddressSanitizer asks it before every throw and exit.
          SCMP_SYS(sigaltstack)}) {
        filter.allow(syscall);
    }
    // abort() raises its signal this way; being killed for that would hide the reason.
    filter.allow(SCMP_SYS(tgkill),
                 argument(0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid())));
    filter.load();
}

void enter_sandbox(const SandboxLimits& limits, pid_t parent) {
    require(prctl(PR_SET_PDEATHSIG, SIGKILL) == 0, errno, "PR_SET_PDEATHSIG");
    require(getppid() == parent, ESRCH, "the parent has gone");
    require(prctl(PR_SET_DUMPABLE, 0) == 0, errno, "PR_SET_DUMPABLE");
    require(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0, errno, "PR_SET_NO_NEW_PRIVS");
    set_limit(RLIMIT_FSIZE, 0, "RLIMIT_FSIZE");
    set_limit(RLIMIT_NOFILE, 3, "RLIMIT_NOFILE");
    set_limit(RLIMIT_CPU, limits.cpu_seconds, "RLIMIT_CPU");
    if (kCanBoundAddressSpace) {
        set_limit(RLIMIT_AS, limits.address_space_bytes, "RLIMIT_AS");
    }
    load_filter();
}

[[noreturn]] void end_like(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        require(errno == EINTR, errno, "waitpid");
    }
    if (WIFSIGNALED(status)) {
        std::signal(WTERMSIG(status), SIG_DFL);
        std::raise(WTERMSIG(status));
    }
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE);
}

}  // namespace

void run_sandboxed(const SandboxLimits& limits, const std::function<int()>& body) {
    set_limit(RLIMIT_CORE, 0, "RLIMIT_CORE");
    require(prctl(PR_SET_PDEATHSIG, SIGKILL) == 0, errno, "PR_SET_PDEATHSIG");
    const pid_t parent = getpid();
    const pid_t child = fork();
    require(child >= 0, errno, "fork");
    if (child > 0) {
        end_like(child);
    }
    try {
        enter_sandbox(limits, parent);
    } catch (const std::system_error& e) {
        std::fprintf(stderr, "sandbox: %s\n", e.what());
        _exit(EXIT_FAILURE);
    }
    // Not exit: destructors of libraries might want system calls that are no longer allowed.
    _exit(body());
}

}  // namespace relume::decoder
