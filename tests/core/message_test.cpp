// Tests writing messages to the user, and writing to standard output. Each test runs in a child process, since it
// closes standard output.

#include "core/message.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <functional>

namespace defocus::engine {
namespace {

int exitCodeOf(const std::function<int()>& action) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(action());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(Message, isLostWhereItCannotBeWritten) {
    for (const char* device : {"/dev/full", ""}) {
        const auto print = [device] {
            ::close(STDERR_FILENO);
            if (*device != '\0' && ::open(device, O_WRONLY) != STDERR_FILENO) return 2;
            printMessage("{} of {}\n", 1, 2);
            writeMessage("once more\n");
            return 0;
        };
        EXPECT_EQ(exitCodeOf(print), 0) << device;
    }
}

TEST(Message, holdsNothingThatATerminalObeys) {
    EXPECT_EQ(printable("a\x1b[31mb\x07\tc\x7f\n"), "a?[31mb??c?\n");
    EXPECT_EQ(printable("\xC2\x9B"
                        "31m \xC3\xA9 \xC2\xA0"),
              "?31m \xC3\xA9 \xC2\xA0");
}

TEST(Message, closedOutputsAreNotTakenByOtherFiles) {
    const auto print = [] {
        ::close(STDOUT_FILENO);
        claimClosedOutputs();
        if (::open("/dev/null", O_RDONLY) <= STDERR_FILENO) return 2;
        std::fputs("lost\n", stdout);
        return std::fflush(stdout) == 0 ? 3 : 0;
    };
    EXPECT_EQ(exitCodeOf(print), 0);
}

}  // namespace
}  // namespace defocus::engine
