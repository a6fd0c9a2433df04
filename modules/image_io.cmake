# By pkg-config first: the CMake package of some distributions fails unless OpenImageIO's programs
# are installed as well.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(OpenImageIO QUIET IMPORTED_TARGET OpenImageIO)
endif()
if(TARGET PkgConfig::OpenImageIO)
  target_link_libraries(${target} PRIVATE PkgConfig::OpenImageIO)
else()
  find_package(OpenImageIO CONFIG REQUIRED)
  target_link_libraries(${target} PRIVATE OpenImageIO::OpenImageIO)
endif()
