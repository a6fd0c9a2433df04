# cmake -DPAGE=index.html -DCHART_JS=chart.min.js -DOUTPUT=page_text.cpp -P bundle.cmake
# Replaces the page's <script src="..."> and <link rel="stylesheet" href="..."> by what they name and
# writes the result as a C++ string; chart.min.js is CHART_JS, other names are files beside PAGE.
get_filename_component(folder ${PAGE} DIRECTORY)
file(READ ${PAGE} page)

function(read_source name out)
  if(name STREQUAL "chart.min.js")
    file(READ ${CHART_JS} text)
    string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" text "${text}")
  else()
    file(READ ${folder}/${name} text)
  endif()
  string(FIND "${text}" "</script" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "${name} contains </script, which would end its element")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

string(REGEX MATCHALL "<script src=\"[^\"]+\"></script>" scripts "${page}")
foreach(element ${scripts})
  string(REGEX REPLACE ".*src=\"([^\"]+)\".*" "\\1" name "${element}")
  read_source(${name} text)
  string(REPLACE "${element}" "<script>\n${text}</script>" page "${page}")
endforeach()
string(REGEX MATCHALL "<link rel=\"stylesheet\" href=\"[^\"]+\">" sheets "${page}")
foreach(element ${sheets})
  string(REGEX REPLACE ".*href=\"([^\"]+)\".*" "\\1" name "${element}")
  read_source(${name} text)
  string(REPLACE "${element}" "<style>\n${text}</style>" page "${page}")
endforeach()

# Bytes as octal would need arithmetic; hexadecimal escapes end where the next one begins.
file(WRITE ${OUTPUT}.html "${page}")
file(READ ${OUTPUT}.html bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
file(WRITE ${OUTPUT} "// Made by app/report/bundle.cmake.
#include \"app/report/page_text.h\"

namespace pssmlt {

std::string_view page_text() {
  static constexpr char text[] = \"${bytes}\";
  return {text, sizeof text - 1};
}

}  // namespace pssmlt
")
