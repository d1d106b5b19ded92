# Generates shell completions and the manual page with the built program, and installs them in the standard folders of
# shells and man.
include(GNUInstallDirs)
set(PAGES "${PROJECT_BINARY_DIR}/pages")
file(MAKE_DIRECTORY "${PAGES}")
add_custom_command(TARGET defocus_program POST_BUILD
    COMMAND defocus_program completions bash > "${PAGES}/defocus"
    COMMAND defocus_program completions zsh > "${PAGES}/_defocus"
    COMMAND defocus_program completions fish > "${PAGES}/defocus.fish"
    COMMAND defocus_program man > "${PAGES}/defocus.1"
    COMMENT "Writing completions and the manual page" VERBATIM)
install(FILES "${PAGES}/defocus" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT program)
install(FILES "${PAGES}/_defocus" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" COMPONENT program)
install(FILES "${PAGES}/defocus.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" COMPONENT program)
install(FILES "${PAGES}/defocus.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
