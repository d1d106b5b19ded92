# cmake --install: the program, the libraries, the headers, and find_package(defocus) with the target defocus::defocus.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(defocus INTERFACE)
add_library(defocus::defocus ALIAS defocus)
target_link_libraries(defocus INTERFACE defocus_frame)

set(MODULES core image scene school lens simplify pyramid plan gl render frame)
get_property(ABSENT GLOBAL PROPERTY DEFOCUS_ABSENT)
list(TRANSFORM ABSENT REPLACE "(.+)" "PATTERN;\\1.h;EXCLUDE" OUTPUT_VARIABLE ABSENT_PATTERNS)
list(TRANSFORM MODULES PREPEND defocus_ OUTPUT_VARIABLE MODULE_TARGETS)
install(TARGETS defocus ${MODULE_TARGETS} EXPORT defocusTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(TARGETS defocus_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
foreach(MODULE IN ITEMS core image scene lens lod plan gl render frame)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/src/${MODULE}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/defocus"
            FILES_MATCHING PATTERN "*.h" ${ABSENT_PATTERNS})
endforeach()
install(EXPORT defocusTargets NAMESPACE defocus:: DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/defocus")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/defocusConfig.cmake.in"
                              "${CMAKE_CURRENT_BINARY_DIR}/defocusConfig.cmake"
                              INSTALL_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/defocus")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/defocusConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/defocusConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/defocusConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/defocusDependencies.cmake"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/defocus")
