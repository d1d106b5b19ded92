# Runs before cpack makes the Debian package. Compresses the man page, and adds Debian's changelog, whose date is the
# release date in the metainfo file.

file(GLOB_RECURSE MANUAL "${CPACK_TEMPORARY_DIRECTORY}/defocus.1")
file(GLOB_RECURSE COPYRIGHT "${CPACK_TEMPORARY_DIRECTORY}/copyright")
file(GLOB_RECURSE METAINFO "${CPACK_TEMPORARY_DIRECTORY}/defocus.metainfo.xml")
if(NOT MANUAL OR NOT COPYRIGHT OR NOT METAINFO)
    message(FATAL_ERROR "The package lacks its man page, copyright or metainfo.")
endif()

file(STRINGS "${METAINFO}" RELEASE REGEX "<release ")
string(REGEX REPLACE ".* date=\"([0-9-]+)\".*" "\\1" DAY "${RELEASE}")
execute_process(COMMAND date --utc --rfc-email "--date=${DAY}" OUTPUT_VARIABLE DATE OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
get_filename_component(PAGES "${COPYRIGHT}" DIRECTORY)
file(WRITE "${PAGES}/changelog" "defocus (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Release ${CPACK_PACKAGE_VERSION}.

 -- ${CPACK_PACKAGE_CONTACT}  ${DATE}
")
execute_process(COMMAND gzip -9n "${MANUAL}" "${PAGES}/changelog" COMMAND_ERROR_IS_FATAL ANY)
