find_package(OpenColorIO REQUIRED)
target_link_libraries(${target} PRIVATE OpenColorIO::OpenColorIO)
