#pragma once
// Stops a child process at a chosen system call that changes a file, with ptrace(2). Tests can thus act at a defined
// point of the child's work, independent of timing.

#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace defocus::engine {

class TracedChild {
public:
    // Forks a child that executes `run`. Counted system calls are writes to files in folders named `folder`, and all
    // renames of files. Calls for the driver's shader cache do not count.
    TracedChild(const std::function<void()>& run, std::string folder) : folder_("/" + std::move(folder) + "/") {
        child_ = ::fork();
        if (child_ == 0) {
            ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
            ::raise(SIGSTOP);  // waits until the parent has set its tracing options
            run();
            ::_exit(97);
        }
        int status = 0;
        ::waitpid(child_, &status, 0);
        const long options = PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL;
        traced_ = WIFSTOPPED(status) && ::ptrace(PTRACE_SETOPTIONS, child_, nullptr, options) == 0;
        if (traced_) ::ptrace(PTRACE_SYSCALL, child_, nullptr, nullptr);
    }
    TracedChild(const TracedChild&) = delete;
    TracedChild& operator=(const TracedChild&) = delete;
    ~TracedChild() {
        if (exitCode_ >= 0) return;
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, __WALL);
    }

    [[nodiscard]] bool traced() const { return traced_; }  // false if the system does not allow tracing
    [[nodiscard]] int calls() const { return calls_; }     // number of counted calls so far

    // Continues the child to its end. Before the child executes its counted system call number `call` (1 is the first;
    // the constructor says which calls count), sends `signal` to the child. Before each counted call, calls `look` with
    // the child's process id while the thread of the child that makes the call is stopped. Returns the exit code, or
    // 128 + the number of the signal that ended the child.
    int end(int call = 0, int signal = 0, const std::function<void(pid_t)>& look = {}) {
        while (exitCode_ < 0) {
            int status = 0;
            const pid_t thread = ::waitpid(-1, &status, __WALL);
            if (thread < 0) break;
            if (!WIFSTOPPED(status)) {
                if (thread == child_) exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
                continue;
            }
            const int reason = WSTOPSIG(status);
            const bool atCall = reason == (SIGTRAP | 0x80);
            if (atCall && counts(thread)) {
                if (++calls_ == call) ::kill(child_, signal);
                if (look) look(child_);
            }
            // SIGTRAP and SIGSTOP come from ptrace and are dropped; all other signals go to the child
            const bool own = atCall || reason == SIGTRAP || reason == SIGSTOP;
            ::ptrace(PTRACE_SYSCALL, thread, nullptr, own ? 0 : static_cast<long>(reason));
        }
        return exitCode_;
    }

private:
    [[nodiscard]] bool counts(pid_t thread) const {
        __ptrace_syscall_info info{};
        const auto size = reinterpret_cast<void*>(sizeof info);
        if (::ptrace(PTRACE_GET_SYSCALL_INFO, thread, size, &info) <= 0 || info.op != PTRACE_SYSCALL_INFO_ENTRY)
            return false;
        constexpr std::array writes = {SYS_write, SYS_pwrite64, SYS_writev};
        constexpr std::array moves = {SYS_renameat, SYS_renameat2};
        const auto call = static_cast<long>(info.entry.nr);
#ifdef SYS_rename
        if (call == SYS_rename) return !ofTheDriver(thread, info.entry.args[1]);
#endif
        if (std::ranges::find(moves, call) != moves.end()) return !ofTheDriver(thread, info.entry.args[3]);
        if (std::ranges::find(writes, call) == writes.end()) return false;
        std::error_code ignored;
        const std::string link = "/proc/" + std::to_string(thread) + "/fd/" + std::to_string(info.entry.args[0]);
        return std::filesystem::read_symlink(link, ignored).string().find(folder_) != std::string::npos;
    }

    // Returns whether the path at `address` in the thread's memory lies inside the folder of Mesa's shader cache.
    static bool ofTheDriver(pid_t thread, std::uint64_t address) {
        std::ifstream memory("/proc/" + std::to_string(thread) + "/mem", std::ios::binary);
        memory.seekg(static_cast<std::streamoff>(address));
        std::string name;
        std::getline(memory, name, '\0');
        return name.find("mesa_shader_cache") != std::string::npos;
    }

    std::string folder_;
    pid_t child_ = -1;
    bool traced_ = false;
    int calls_ = 0;
    int exitCode_ = -1;
};

}  // namespace defocus::engine
