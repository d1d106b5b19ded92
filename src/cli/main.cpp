// The program `defocus`: renders images with the depth of field of a real lens.

#include "cli/run_program.h"
#include "core/memory.h"

int main(int argc, char** argv) {
    defocus::engine::keepFreedMemory();
    return defocus::engine::runProgram(argc, argv);
}
