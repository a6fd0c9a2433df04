target_sources(${target} PRIVATE vocabulary/vocabulary.cpp)
