# Bundles app/report/page/ and Debian's Chart.js into one HTML text and compiles it into pssmlt_app,
# so that the program finds it wherever it is installed.
set(PSSMLT_CHART_JS /usr/share/javascript/chart.js/chart.min.js CACHE FILEPATH
    "Chart.js 3.9 or later of the 3 series, minified (Debian: libjs-chart.js)")
if(NOT EXISTS ${PSSMLT_CHART_JS})
  message(FATAL_ERROR "Chart.js, which the comparison report draws with, is not at "
    "${PSSMLT_CHART_JS}. Install Debian's package libjs-chart.js, or name the file by "
    "-DPSSMLT_CHART_JS=...")
endif()
file(GLOB page_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/app/report/page/*)
set(page_text ${PROJECT_BINARY_DIR}/generated/page_text.cpp)
add_custom_command(OUTPUT ${page_text}
  COMMAND ${CMAKE_COMMAND} -DPAGE=${PROJECT_SOURCE_DIR}/app/report/page/index.html
          -DCHART_JS=${PSSMLT_CHART_JS} -DOUTPUT=${page_text}
          -P ${PROJECT_SOURCE_DIR}/app/report/bundle.cmake
  DEPENDS ${page_files} ${PSSMLT_CHART_JS} ${PROJECT_SOURCE_DIR}/app/report/bundle.cmake
  VERBATIM)
target_sources(pssmlt_app PRIVATE ${page_text})
