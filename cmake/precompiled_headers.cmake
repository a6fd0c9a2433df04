# pssmlt_precompile(TARGET [REUSE OTHER] [HEADERS ...]): precompiles what most files include of other
# libraries (never headers of this tree: a change to one of them would rebuild everything), or reuses
# what OTHER, built with the same options, has precompiled. Files include what they use all the same;
# -DPSSMLT_PCH=OFF builds without.
set(PSSMLT_PRECOMPILED <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
    <numbers> <optional> <span> <sstream> <string> <string_view> <utility> <vector> <fmt/format.h>
    <glm/glm.hpp>)

function(pssmlt_precompile target)
  cmake_parse_arguments(pch "" "REUSE" "HEADERS" ${ARGN})
  if(NOT PSSMLT_PCH)
    return()
  endif()
  if(pch_REUSE)
    target_precompile_headers(${target} REUSE_FROM ${pch_REUSE})
  else()
    target_precompile_headers(${target} PRIVATE ${PSSMLT_PRECOMPILED} ${pch_HEADERS})
  endif()
endfunction()
