# Distributions install OpenColorIO with pkg-config's file, with CMake's, or with both.
find_package(OpenColorIO CONFIG QUIET)
if(TARGET OpenColorIO::OpenColorIO)
  target_link_libraries(${target} PRIVATE OpenColorIO::OpenColorIO)
else()
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(OpenColorIO REQUIRED IMPORTED_TARGET OpenColorIO)
  target_link_libraries(${target} PRIVATE PkgConfig::OpenColorIO)
endif()
