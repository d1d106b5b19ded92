# Script that writes OUTPUT, a C++ file with the checked-out commit of repository SOURCE, if the commit has changed. It
# takes no git locks, so that it does not disturb concurrent git commands.
execute_process(COMMAND git --no-optional-locks -C "${SOURCE}" rev-parse --short=12 HEAD
                OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE FAULT)
if(FAULT)
    set(COMMIT "")
else()
    execute_process(COMMAND git --no-optional-locks -C "${SOURCE}" diff --quiet HEAD ERROR_QUIET RESULT_VARIABLE CHANGED)
    if(CHANGED)
        string(APPEND COMMIT "-changed")
    endif()
endif()
set(TEXT "// Generated.\n#include \"frame/program_facts.h\"\n\nnamespace defocus::engine {\n\n")
string(APPEND TEXT "std::string programCommit() {\n    return \"${COMMIT}\";\n}\n\n}  // namespace defocus::engine\n")
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "${TEXT}" @ONLY)
