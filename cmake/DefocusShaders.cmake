# defocus_embed_shaders(TARGET DIR) embeds every shader file under DIR as a string in TARGET, so that no files are
# needed at run time.

function(defocus_embed_shaders TARGET DIR)
    file(GLOB_RECURSE SHADERS CONFIGURE_DEPENDS RELATIVE "${DIR}" "${DIR}/*.glsl" "${DIR}/*.vert" "${DIR}/*.frag"
                                                                  "${DIR}/*.tesc" "${DIR}/*.tese" "${DIR}/*.geom"
                                                                  "${DIR}/*.comp")
    set(OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp")
    list(TRANSFORM SHADERS PREPEND "${DIR}/" OUTPUT_VARIABLE SHADER_PATHS)
    add_custom_command(
        OUTPUT "${OUTPUT}"
        COMMAND "${CMAKE_COMMAND}" "-DDIR=${DIR}" "-DOUTPUT=${OUTPUT}" "-DSHADERS=${SHADERS}"
                -P "${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake"
        DEPENDS ${SHADER_PATHS} "${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake"
        COMMENT "Embedding shaders"
        VERBATIM)
    target_sources(${TARGET} PRIVATE "${OUTPUT}")
endfunction()
