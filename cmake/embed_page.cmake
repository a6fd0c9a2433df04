# pssmlt_embed_page(TARGET FUNCTION FOLDER [FILE ...]): compiles the folder's files and the others into
# TARGET, as what FUNCTION of app/page_file.h returns; the program finds them wherever it is installed.
# index.html is the page itself, "/". As a script (cmake -DOUTPUT=... -DFUNCTION=... -DFOLDER=...
# -DMORE=... -P embed_page.cmake) it writes that function.
function(pssmlt_embed_page target function folder)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*)
  set(output ${PROJECT_BINARY_DIR}/generated/${function}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFUNCTION=${function} -DFOLDER=${folder}
            "-DMORE=${ARGN}" -P ${script}
    DEPENDS ${files} ${ARGN} ${script} VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()
set(type_html "text/html; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(entries "")
file(GLOB files ${FOLDER}/*)
foreach(file ${files} ${MORE})
  get_filename_component(name ${file} NAME)
  get_filename_component(ending ${file} LAST_EXT)
  string(SUBSTRING "${ending}" 1 -1 ending)
  if(NOT DEFINED type_${ending})
    message(FATAL_ERROR "${file}: no type is known for this ending")
  endif()
  if(name STREQUAL "index.html")
    set(name "")
  endif()
  # Bytes as octal would need arithmetic; hexadecimal escapes end where the next one begins.
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  string(APPEND entries "      {\"/${name}\", \"${type_${ending}}\", \"${bytes}\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Made by cmake/embed_page.cmake.
#include \"app/page_file.h\"

namespace pssmlt {

std::vector<PageFile> ${FUNCTION}() {
  return {
${entries}  };
}

}  // namespace pssmlt
")
