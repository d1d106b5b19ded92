// defocus: depth of field of a real lens.

#include "cli/run_program.h"

int main(int argc, char** argv) {
    return defocus::runProgram(argc, argv);
}
