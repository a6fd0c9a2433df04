# OpenImageIO's targets drag in its own dependencies; only this module sees them.
find_package(OpenImageIO REQUIRED)
target_link_libraries(${target} PRIVATE OpenImageIO::OpenImageIO)
