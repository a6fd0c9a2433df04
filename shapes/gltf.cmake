find_library(PSSMLT_TINYGLTF tinygltf REQUIRED)
target_link_libraries(${target} PRIVATE ${PSSMLT_TINYGLTF})
