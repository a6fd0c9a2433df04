foreach(part page pictures reviewed stage vocabulary word_text)
  target_sources(${target} PRIVATE vocabulary/${part}.cpp)
endforeach()
