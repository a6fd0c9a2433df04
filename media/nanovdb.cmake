# Compressed files need both.
target_link_libraries(${target} PRIVATE ZLIB::ZLIB blosc)
