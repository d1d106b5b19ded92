// Injects system faults into a program that preloads this library (LD_PRELOAD). Environment variables select the
// faults:
//   FAULT_LOCKS=1      flock(2) fails as on a file system without locks
//   FAULT_CLOCK=1      the wall clock goes back by an hour with each reading
//   FAULT_EGL=A,B      EGL does not list these extensions
//   FAULT_GL_MEMORY=N  from call N of glGetError on, every second call returns "out of memory": code that clears
//                      errors, allocates, and checks again then sees the fault

#include <dlfcn.h>
#include <sys/file.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <set>
#include <sstream>
#include <string>
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
constexpr int eglExtensions = 0x3055;     // EGL_EXTENSIONS

// libepoxy calls OpenGL through function pointers. On the first call, the function behind a pointer looks up the
// driver's function and stores it in the pointer.
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

using QueryString = const char* (*)(void*, int);
QueryString* queryEntry = nullptr;
QueryString realQuery = nullptr;

const char* withoutExtensions(void* display, int name) {
    *queryEntry = realQuery;
    const char* const text = realQuery(display, name);
    realQuery = std::exchange(*queryEntry, &withoutExtensions);
    if (text == nullptr || name != eglExtensions) return text;
    static std::set<std::string> kept;  // keeps the returned C strings valid
    const std::string hidden = "," + std::string(std::getenv("FAULT_EGL")) + ",";
    std::istringstream words(text);
    std::string left;
    for (std::string word; words >> word;)
        if (hidden.find("," + word + ",") == std::string::npos) left += word + " ";
    return kept.insert(left).first->c_str();
}

[[gnu::constructor]] void begin() {
    if (asked("FAULT_EGL")) {
        queryEntry = static_cast<QueryString*>(::dlsym(RTLD_DEFAULT, "epoxy_eglQueryString"));
        if (queryEntry != nullptr) realQuery = std::exchange(*queryEntry, &withoutExtensions);
    }
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
