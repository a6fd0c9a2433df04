find_library(PSSMLT_TINYGLTF tinygltf REQUIRED)
file(GLOB gltf_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/modules/gltf/*.cpp)
target_sources(${target} PRIVATE ${gltf_sources})
target_link_libraries(${target} PRIVATE ${PSSMLT_TINYGLTF})
