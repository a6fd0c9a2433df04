# The tables, and a plugin that the program must refuse.
target_sources(${target} PRIVATE bad_input/run_program.cpp bad_input/syntax_cases.cpp
               bad_input/shape_cases.cpp bad_input/file_cases.cpp
               bad_input/gltf_cases.cpp)
add_library(pssmlt_stale_plugin MODULE bad_input/stale_plugin.cpp)
target_link_libraries(pssmlt_stale_plugin PRIVATE pssmlt_core pssmlt_flags)
add_dependencies(${target} pssmlt_stale_plugin)
target_compile_definitions(${target} PRIVATE PSSMLT_STALE_PLUGIN="$<TARGET_FILE:pssmlt_stale_plugin>"
                           PSSMLT_OTHER_LIBRARY="$<TARGET_FILE:pssmlt_core>")
