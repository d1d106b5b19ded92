#include "core/message.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace defocus {

void writeMessage(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

void claimClosedOutputs() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
        if (::fcntl(descriptor, F_GETFD) < 0)
            static_cast<void>(::open("/dev/null", O_RDONLY));  // the lowest that is free
}

}  // namespace defocus
