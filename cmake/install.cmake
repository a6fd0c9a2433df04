# bin/pssmlt, lib/libpssmlt.so, lib/pssmlt/<kind>/<name>.so, headers and a CMake package.
include(CMakePackageConfigHelpers)
install(TARGETS pssmlt RUNTIME DESTINATION bin)
install(TARGETS pssmlt_core EXPORT pssmlt_targets LIBRARY DESTINATION lib)
install(DIRECTORY core DESTINATION include/pssmlt FILES_MATCHING PATTERN "*.h")
install(EXPORT pssmlt_targets NAMESPACE pssmlt:: DESTINATION lib/cmake/pssmlt)
configure_package_config_file(cmake/pssmltConfig.cmake.in ${PROJECT_BINARY_DIR}/pssmltConfig.cmake
                              INSTALL_DESTINATION lib/cmake/pssmlt)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pssmltConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pssmltConfig.cmake
              ${PROJECT_BINARY_DIR}/pssmltConfigVersion.cmake cmake/pssmlt_add_plugin.cmake
        DESTINATION lib/cmake/pssmlt)
