# Installs desktop files, and sets up the Debian package that `cpack` makes (scripts/debian-package): the program with
# its manual page, shell completions and desktop files, and the Python package if it is built.

set(DESKTOP "${PROJECT_SOURCE_DIR}/packaging")
configure_file("${DESKTOP}/defocus.metainfo.xml.in" "${PROJECT_BINARY_DIR}/pages/defocus.metainfo.xml" @ONLY)
if(DEFOCUS_VIEWER)
    install(FILES "${DESKTOP}/defocus.desktop" DESTINATION "${CMAKE_INSTALL_DATADIR}/applications" COMPONENT program)
    install(FILES "${DESKTOP}/defocus.svg" DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps" COMPONENT program)
    install(FILES "${DESKTOP}/defocus-mime.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/mime/packages"
            RENAME defocus.xml COMPONENT program)
    install(FILES "${PROJECT_BINARY_DIR}/pages/defocus.metainfo.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo"
            COMPONENT program)
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/defocus" RENAME copyright
        COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME defocus)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "renderer of glTF scenes with the depth of field of a real lens")
set(CPACK_PACKAGE_DESCRIPTION
    "defocus draws glTF scenes as a camera with a real lens sees them: with an
aperture of any shape, focus breathing, aberrations and motion blur. It
renders images and films from the command line, shows scenes in a window,
and has a Python module.")
set(CPACK_PACKAGE_CONTACT "the defocus authors <defocus@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
# The program loads OpenGL at run time, so dpkg-shlibdeps does not detect the dependency.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1, libgl1-mesa-dri")
if(DEFOCUS_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
    math(EXPR NEXT_MINOR "${Python_VERSION_MINOR} + 1")
    string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), "
           "python3 (<< ${Python_VERSION_MAJOR}.${NEXT_MINOR}), python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, blender")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Debian's policy requires a compressed man page and a changelog.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/DebianPages.cmake")
include(CPack)
