#include "app/command.h"

namespace defocus {

std::string programVersion() {
    return DEFOCUS_VERSION;
}

}  // namespace defocus
