find_package(PkgConfig REQUIRED)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib)
target_link_libraries(${target} PRIVATE PkgConfig::httplib Threads::Threads)
