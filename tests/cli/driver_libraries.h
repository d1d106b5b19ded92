#pragma once
// Loads the libraries that OpenGL's driver consists of, a compiler among them, and nothing more: copies of this process
// that draw needn't load and bind them anew, which takes a fifth of a second each.

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "core/error.h"
#include "gl/context.h"

namespace defocus {

// Which libraries they are tells a process that has made a context: a driver also begins threads, which can't be
// copied. Without a context, none are loaded.
inline void loadLibrariesOfDriver() {
    int ends[2];
    if (::pipe(ends) != 0) return;
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            const auto context = createHeadlessContext();
            std::ifstream maps("/proc/self/maps");
            std::string paths;
            for (std::string line; std::getline(maps, line);) {
                const std::size_t path = line.find('/');
                if (path == std::string::npos || line.find(".so", path) == std::string::npos) continue;
                line.erase(0, path);
                line += '\n';
                if (!paths.ends_with(line)) paths += line;
            }
            if (::write(ends[1], paths.data(), paths.size()) < 0) ::_exit(1);
        } catch (const Error&) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string path;
    for (char letter = 0; ::read(ends[0], &letter, 1) == 1;)
        if (letter != '\n') {
            path += letter;
        } else {
            ::dlopen(path.c_str(), RTLD_NOW);
            path.clear();
        }
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
}

}  // namespace defocus
