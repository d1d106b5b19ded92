# defocus_module(NAME [FOLDER folder] [ONLY file] [WITHOUT file] LINK ...) builds static library defocus_NAME from
# folder src/NAME (or src/FOLDER) and its subfolders. ONLY builds a single .cpp file of the folder; WITHOUT omits one. A
# module links only modules that src/CMakeLists.txt lists before it, so that includes of later modules fail to build.

add_library(defocus_options INTERFACE)
target_compile_features(defocus_options INTERFACE cxx_std_20)
target_compile_options(defocus_options INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor)
if(NOT CMAKE_UNITY_BUILD)  # in unity builds, a local name may shadow a function of another source file
    target_compile_options(defocus_options INTERFACE -Wshadow)
endif()
# In unity builds, GCC's garbage collection takes up to a fifth of the compile time. A larger initial heap delays the
# first collection.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(defocus_options INTERFACE --param=ggc-min-heapsize=1000000)  # in kB
endif()
if(DEFOCUS_WARNINGS_AS_ERRORS)
    target_compile_options(defocus_options INTERFACE -Werror)
endif()
if(DEFOCUS_SANITIZE)
    target_compile_options(defocus_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                     -fno-omit-frame-pointer)
    target_link_options(defocus_options INTERFACE -fsanitize=address,undefined)
endif()
if(DEFOCUS_FUZZ)
    target_compile_options(defocus_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Unity builds precompile the headers that most sources include. The first module builds them; the others reuse them,
# because all modules have the same compile options. Other builds have no precompiled headers, so that they detect
# missing includes.
function(defocus_precompiled TARGET)
    if(NOT CMAKE_UNITY_BUILD)
        return()
    endif()
    if("${TARGET}" STREQUAL "defocus_core")
        target_precompile_headers(${TARGET} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory>
                                  <numbers> <numeric> <optional> <set> <span> <string> <vector> <fmt/format.h>
                                  <glm/geometric.hpp> <glm/gtc/matrix_transform.hpp> <nlohmann/json.hpp>)
        target_include_directories(${TARGET} PRIVATE $<TARGET_PROPERTY:nlohmann_json::nlohmann_json,INTERFACE_INCLUDE_DIRECTORIES>)
    else()
        target_precompile_headers(${TARGET} REUSE_FROM defocus_core)
    endif()
endfunction()

function(defocus_module NAME)
    cmake_parse_arguments(ARG "" "ONLY;WITHOUT;FOLDER" "LINK;PRIVATE_LINK" ${ARGN})
    if(NOT ARG_FOLDER)
        set(ARG_FOLDER ${NAME})
    endif()
    file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER}/*.cpp")
    if(ARG_WITHOUT)
        list(REMOVE_ITEM SOURCES "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER}/${ARG_WITHOUT}.cpp")
    endif()
    if(ARG_ONLY)
        set(SOURCES "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER}/${ARG_ONLY}.cpp")
    endif()
    add_library(defocus_${NAME} STATIC ${SOURCES})
    # The shared library exports only declarations with DEFOCUS_API.
    set_target_properties(defocus_${NAME} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                                     VISIBILITY_INLINES_HIDDEN ON)
    target_include_directories(defocus_${NAME} PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/include"
                                                      "${PROJECT_BINARY_DIR}/include")
    target_link_libraries(defocus_${NAME} PUBLIC ${ARG_LINK} PRIVATE defocus_options ${ARG_PRIVATE_LINK})
    defocus_precompiled(defocus_${NAME})
    target_compile_features(defocus_${NAME} PUBLIC cxx_std_20)
endfunction()
