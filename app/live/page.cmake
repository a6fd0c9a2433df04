# Compiles app/live/page/ into pssmlt_app, so that the program finds it wherever it is installed.
file(GLOB live_page CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/app/live/page/*)
set(live_page_files ${PROJECT_BINARY_DIR}/generated/live_page_files.cpp)
add_custom_command(OUTPUT ${live_page_files}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/app/live/page -DOUTPUT=${live_page_files}
          -P ${PROJECT_SOURCE_DIR}/app/live/embed.cmake
  DEPENDS ${live_page} ${PROJECT_SOURCE_DIR}/app/live/embed.cmake VERBATIM)
target_sources(pssmlt_app PRIVATE ${live_page_files})
