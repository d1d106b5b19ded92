// defocus: depth of field of a real lens.

#include "app/run_program.h"

int main(int argc, char** argv) {
    return defocus::runProgram(argc, argv);
}
