#include "core/thread_times.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace defocus::engine {

namespace {

// Returns the CPU time of each thread of this process in ms, from /proc/self/task/ID/schedstat, which begins with the
// time in ns. Empty on systems other than Linux.
std::map<int, double> timesOfThreads() {
    std::map<int, double> times;
    std::error_code none;
    for (std::filesystem::directory_iterator entry("/proc/self/task", none), end; !none && entry != end;
         entry.increment(none)) {
        const std::string name = entry->path().filename().string();
        int thread = 0;
        std::from_chars(name.data(), name.data() + name.size(), thread);
        std::ifstream file(entry->path() / "schedstat");
        if (double nanoseconds = 0; file >> nanoseconds) times[thread] = nanoseconds * 1e-6;
    }
    return times;
}

}  // namespace

void CpuClock::start() {
    before_ = timesOfThreads();
}

CpuTime CpuClock::elapsed() const {
    CpuTime time;
    for (const auto& [thread, milliseconds] : timesOfThreads()) {
        const auto before = before_.find(thread);
        const double own = milliseconds - (before == before_.end() ? 0 : before->second);
        time.milliseconds += own;
        time.busiestMilliseconds = std::max(time.busiestMilliseconds, own);
    }
    return time;
}

}  // namespace defocus::engine
