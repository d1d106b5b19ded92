# Links the object files of all modules into one library, and installs it with CMake's find_package(defocus), target
# defocus::defocus, and pkg-config.
#
# BUILD_SHARED_LIBS selects a static or a shared library. If tests are built, the other kind is linked too, from the
# same objects. `cmake --install BUILD --component static` or `--component shared` installs one kind, without the
# program.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(LIBRARY_OBJECTS "")
foreach(MODULE IN ITEMS core image scene school lens simplify pyramid plan gl render frame refocus)
    list(APPEND LIBRARY_OBJECTS "$<TARGET_OBJECTS:defocus_${MODULE}>")
endforeach()

function(defocus_library TARGET KIND)
    add_library(${TARGET} ${KIND} ${LIBRARY_OBJECTS})
    # Before 1.0, minor versions may be binary-incompatible, so the soname contains the minor version.
    set_target_properties(${TARGET} PROPERTIES OUTPUT_NAME defocus EXPORT_NAME defocus LINKER_LANGUAGE CXX
                                               VERSION "${PROJECT_VERSION}"
                                               SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
    target_include_directories(${TARGET} INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                                                   "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
                                                   "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
    target_compile_features(${TARGET} INTERFACE cxx_std_20)
    set(LIBRARIES OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util fmt::fmt TBB::tbb draco::draco meshoptimizer::meshoptimizer OpenMeshCore
                  ZLIB::ZLIB)
    set(FLAGS PkgConfig::epoxy PkgConfig::egl Threads::Threads)
    if(KIND STREQUAL "SHARED")  # programs that link the shared library need none of these packages
        list(TRANSFORM LIBRARIES REPLACE "(.+)" "$<BUILD_INTERFACE:$<TARGET_LINKER_FILE:\\1>>")
        list(TRANSFORM FLAGS REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
        target_link_options(${TARGET} PRIVATE -Wl,--no-undefined -Wl,--exclude-libs,ALL)
    endif()
    target_link_libraries(${TARGET} PRIVATE "$<BUILD_INTERFACE:defocus_options>" ${LIBRARIES} ${FLAGS})
endfunction()

# Adds the install rules of the static or of the shared library. If IN_ALL is false, `cmake --install` without
# --component omits the library.
function(defocus_install_library TARGET KIND IN_ALL)
    string(TOLOWER ${KIND} COMPONENT)
    set(RULE COMPONENT ${COMPONENT})
    if(NOT IN_ALL)
        list(APPEND RULE EXCLUDE_FROM_ALL)
    endif()
    set(PACKAGE_FOLDER "${CMAKE_INSTALL_LIBDIR}/cmake/defocus")
    set(GENERATED "${PROJECT_BINARY_DIR}/package/${COMPONENT}")

    install(TARGETS ${TARGET} EXPORT ${TARGET}Targets
            LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" ${RULE} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" ${RULE})
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/defocus" "${PROJECT_BINARY_DIR}/include/defocus"
            DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" ${RULE} FILES_MATCHING PATTERN "*.h")

    # Install the CMake package. The targets of the static and of the shared library are in separate files, because
    # CMake generates one file per export name.
    install(EXPORT ${TARGET}Targets FILE defocusTargets-${COMPONENT}.cmake NAMESPACE defocus:: DESTINATION "${PACKAGE_FOLDER}" ${RULE})
    configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/defocusConfig-${COMPONENT}.cmake.in"
                                  "${GENERATED}/defocusConfig.cmake" INSTALL_DESTINATION "${PACKAGE_FOLDER}"
                                  NO_SET_AND_CHECK_MACRO)
    write_basic_package_version_file("${GENERATED}/defocusConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
    install(FILES "${GENERATED}/defocusConfig.cmake" "${GENERATED}/defocusConfigVersion.cmake"
            DESTINATION "${PACKAGE_FOLDER}" ${RULE})

    # Install defocus.pc for pkg-config. The prefix in this file is relative to the file's location.
    file(RELATIVE_PATH PREFIX_FROM_PC "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
    set(PRIVATE_LIBRARIES "")
    if(KIND STREQUAL "STATIC")
        set(PRIVATE_LIBRARIES "Requires.private: OpenImageIO fmt tbb draco epoxy egl zlib\nLibs.private: -lmeshoptimizer -lOpenMeshCore -pthread\n")
    endif()
    configure_file("${PROJECT_SOURCE_DIR}/cmake/defocus.pc.in" "${GENERATED}/defocus.pc" @ONLY)
    install(FILES "${GENERATED}/defocus.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" ${RULE})
endfunction()

if(BUILD_SHARED_LIBS)
    set(KINDS SHARED STATIC)
else()
    set(KINDS STATIC SHARED)
endif()
list(GET KINDS 0 CHOSEN_KIND)
list(GET KINDS 1 OTHER_KIND)
defocus_library(defocus ${CHOSEN_KIND})
add_library(defocus::defocus ALIAS defocus)
defocus_install_library(defocus ${CHOSEN_KIND} TRUE)
if(DEFOCUS_TESTS AND NOT DEFOCUS_SANITIZE)
    defocus_library(defocus_other ${OTHER_KIND})
    defocus_install_library(defocus_other ${OTHER_KIND} FALSE)
endif()
# `cmake --install` also needs the library after a build of only the program, as in scripts/demo and scripts/test.
add_dependencies(defocus_program defocus)
install(TARGETS defocus_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
