#pragma once
// Runs the program `defocus` on machines with OpenGL. On other machines, the tests are skipped and print the reason.

#include "cli/program.h"
#include "core/error.h"
#include "gl/context.h"

namespace defocus::engine {

class GlProgramTest : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        static const std::string reason = whyNoContext();
        if (!reason.empty()) GTEST_SKIP() << reason;
    }

private:
    // Returns the reason why no OpenGL context can be created; empty on success. A child process tries to create the
    // context, so a crash of the driver does not end the tests.
    static std::string whyNoContext() {
        int ends[2];
        if (::pipe(ends) != 0) return "no pipe";
        const pid_t child = ::fork();
        if (child == 0) {
            try {
                createHeadlessContext();
            } catch (const Error& error) {
                const std::string reason = error.what();
                if (::write(ends[1], reason.data(), reason.size()) < 0) ::_exit(1);
            }
            ::_exit(0);
        }
        ::close(ends[1]);
        std::string reason;
        char letter = 0;
        while (::read(ends[0], &letter, 1) == 1) reason += letter;
        ::close(ends[0]);
        int status = 0;
        ::waitpid(child, &status, 0);
        return status == 0 ? reason : "no context: " + reason;
    }
};

}  // namespace defocus::engine
