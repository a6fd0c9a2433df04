# cmake -DFOLDER=page -DOUTPUT=live_page_files.cpp -P embed.cmake: the folder's files as C++ strings;
# index.html is the page itself, "/".
set(type_html "text/html; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(entries "")
file(GLOB files ${FOLDER}/*)
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  get_filename_component(ending ${file} LAST_EXT)
  string(SUBSTRING "${ending}" 1 -1 ending)
  if(NOT DEFINED type_${ending})
    message(FATAL_ERROR "${file}: no type is known for this ending")
  endif()
  if(name STREQUAL "index.html")
    set(name "")
  endif()
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  string(APPEND entries "      {\"/${name}\", \"${type_${ending}}\", \"${bytes}\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Made by app/live/embed.cmake.
#include \"app/live/page_files.h\"

namespace pssmlt {

std::vector<LiveFile> live_page_files() {
  return {
${entries}  };
}

}  // namespace pssmlt
")
