# Without the library the module has no function, and files that need it get an error that says so.
find_path(PSSMLT_DRACO_INCLUDE draco/compression/decode.h)
find_library(PSSMLT_DRACO draco)
if(PSSMLT_DRACO AND PSSMLT_DRACO_INCLUDE)
  target_include_directories(${target} SYSTEM PRIVATE ${PSSMLT_DRACO_INCLUDE})
  target_link_libraries(${target} PRIVATE ${PSSMLT_DRACO})
  target_compile_definitions(${target} PRIVATE PSSMLT_HAS_DRACO)
else()
  message(WARNING "libdraco was not found: glTF files with KHR_draco_mesh_compression will be refused. "
    "Debian's package is libdraco-dev.")
endif()
