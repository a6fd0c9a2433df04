// libFuzzer target: whatever the bytes, the parser returns or throws an Error.
//   clang++ -fsanitize=fuzzer,address,undefined ... && ./parser_fuzz scenes/
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/scene/parser.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    pssmlt::parse_string(text, "fuzz");
  } catch (const pssmlt::Error&) {
  }
  return 0;
}
