// Faults of the system for a program that loads this first (LD_PRELOAD), each asked for by a variable of the
// environment:
//   FAULT_LOCKS=1      flock(2) says that the file system has no locks
//   FAULT_CLOCK=1      the wall clock goes back by an hour each time that it is read
//   FAULT_GL_MEMORY=N  from the Nth question for OpenGL's error on, every second one is answered by out of memory: who
//                      takes what there was of errors, allocates, and asks again, then finds it

#include <dlfcn.h>
#include <sys/file.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <utility>

namespace {

bool asked(const char* variable) {
    return std::getenv(variable) != nullptr;
}

long jump() {
    static std::atomic<long> back = 0;
    return back += 3600;
}

constexpr unsigned outOfMemory = 0x0505;  // GL_OUT_OF_MEMORY

// Epoxy's entry points are variables. Called for the first time, one looks for the driver's function and becomes it.
using GetError = unsigned (*)();
GetError* entry = nullptr;
GetError real = nullptr;

unsigned failing() {
    static std::atomic<int> left = std::atoi(std::getenv("FAULT_GL_MEMORY"));
    *entry = real;
    const unsigned error = real();
    real = std::exchange(*entry, &failing);
    const int now = --left;
    return now <= 0 && now % 2 == 0 ? outOfMemory : error;
}

[[gnu::constructor]] void begin() {
    if (!asked("FAULT_GL_MEMORY")) return;
    entry = static_cast<GetError*>(::dlsym(RTLD_DEFAULT, "epoxy_glGetError"));
    if (entry != nullptr) real = std::exchange(*entry, &failing);
}

}  // namespace

extern "C" {

int flock(int descriptor, int operation) {
    if (asked("FAULT_LOCKS")) {
        errno = ENOLCK;
        return -1;
    }
    static const auto real = reinterpret_cast<int (*)(int, int)>(::dlsym(RTLD_NEXT, "flock"));
    return real(descriptor, operation);
}

int clock_gettime(clockid_t clock, timespec* time) {
    static const auto real = reinterpret_cast<int (*)(clockid_t, timespec*)>(::dlsym(RTLD_NEXT, "clock_gettime"));
    const int result = real(clock, time);
    if (clock == CLOCK_REALTIME && asked("FAULT_CLOCK")) time->tv_sec -= jump();
    return result;
}

time_t time(time_t* result) {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    if (result != nullptr) *result = now.tv_sec;
    return now.tv_sec;
}
}
