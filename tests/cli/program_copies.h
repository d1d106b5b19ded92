#pragma once
// Runs the program in forks of the test process. A fork does not load hundreds of shared libraries, which would take
// longer than most tests. Forks do not copy threads, and GL drivers, image readers and pyramid builds start threads in
// the test process. Therefore the forks are made by a separate process without threads, which is forked before the
// first test.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "cli/run_program.h"

namespace defocus::engine {

struct ProgramRun {
    std::filesystem::path folder;     // working folder
    std::filesystem::path out;        // file for standard output
    std::filesystem::path err;        // file for standard error
    std::filesystem::path cacheHome;  // $XDG_CACHE_HOME
    std::size_t maxFileBytes = 0;     // max file size; writes beyond it fail as on a full disk; 0: no limit
    std::vector<std::string> arguments;
};

class ProgramCopies : public testing::Environment {
public:
    // Returns the status of waitpid(2), or −1 if the process that forks the copies does not exist.
    static int run(const ProgramRun& program) {
        std::string words;  // all strings of the request, each followed by a NUL byte
        const auto add = [&words](const std::string& word) { words += word + '\0'; };
        for (const auto& path : {program.folder, program.out, program.err}) add(path.string());
        add(std::to_string(program.maxFileBytes));
        for (char** variable = environ; *variable != nullptr; ++variable) add(*variable);
        add("XDG_CACHE_HOME=" + program.cacheHome.string());
        add("");
        for (const std::string& word : program.arguments) add(word);
        const std::size_t length = words.size();
        int status = -1;
        if (!write(socket_, &length, sizeof length) || !write(socket_, words.data(), length) ||
            !read(socket_, &status, sizeof status))
            return -1;
        return status;
    }

    void SetUp() override {
        int ends[2];
        ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
        std::fflush(nullptr);  // otherwise each fork would write the buffered output again
        const pid_t process = ::fork();
        ASSERT_GE(process, 0);
        if (process == 0) {
            ::close(ends[0]);
            makeCopies(ends[1]);
        }
        ::close(ends[1]);
        socket_ = ends[0];
        process_ = process;
    }
    void TearDown() override {
        ::close(socket_);  // closing the socket ends the process that forks the copies
        ::waitpid(process_, nullptr, 0);
        socket_ = -1;
    }

private:
    [[noreturn]] static void makeCopies(int socket) {
        std::size_t length = 0;
        while (read(socket, &length, sizeof length)) {
            std::string words(length, '\0');
            if (!read(socket, words.data(), length)) break;
            const pid_t child = ::fork();
            if (child == 0) {
                ::close(socket);
                runProgramIn(words);
            }
            int status = 0;
            ::waitpid(child, &status, 0);
            if (!write(socket, &status, sizeof status)) break;
        }
        ::_exit(0);
    }

    [[noreturn]] static void runProgramIn(const std::string& request) {
        std::istringstream rest(request);
        const auto next = [&rest] {
            std::string word;
            std::getline(rest, word, '\0');
            return word;
        };
        const std::string folder = next();
        const int out = ::open(next().c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        const int err = ::open(next().c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (::chdir(folder.c_str()) != 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) ::_exit(99);
        if (const rlim_t max = std::stoull(next()); max > 0) {
            const rlimit limit{max, max};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        ::clearenv();
        for (std::string variable = next(); !variable.empty(); variable = next()) {
            const std::size_t equals = variable.find('=');
            ::setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
        }
        std::vector<std::string> words = {DEFOCUS_PROGRAM};
        for (std::string word = next(); rest; word = next()) words.push_back(word);
        std::vector<char*> pointers;
        pointers.reserve(words.size() + 1);
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        const int code = runProgram(static_cast<int>(words.size()), pointers.data());
        std::fflush(nullptr);
        ::_exit(code);  // skips the destructors of the test program
    }

    // Writes all bytes; returns false on failure.
    static bool write(int file, const void* data, std::size_t size) {
        for (std::size_t done = 0; done < size;) {
            const ssize_t count = ::send(file, static_cast<const char*>(data) + done, size - done, MSG_NOSIGNAL);
            if (count <= 0) return false;
            done += static_cast<std::size_t>(count);
        }
        return true;
    }
    static bool read(int file, void* data, std::size_t size) {
        for (std::size_t done = 0; done < size;) {
            const ssize_t count = ::read(file, static_cast<char*>(data) + done, size - done);
            if (count <= 0) return false;
            done += static_cast<std::size_t>(count);
        }
        return true;
    }

    static inline int socket_ = -1;
    static inline pid_t process_ = -1;
};

inline testing::Environment* const programCopies = testing::AddGlobalTestEnvironment(new ProgramCopies);

}  // namespace defocus::engine
