// The numbers that accessors name. Every range is checked against its buffer before it is read.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/gltf/document.h"

namespace pssmlt::gltf {

// Elements of `components` numbers each, one after the other; normalized integers become fractions,
// sparse ones are put in place. `pointer`: who asks. Throws Error if the accessor does not exist,
// has another type, or reaches beyond its buffer.
std::vector<float> read_floats(const Document& document, int accessor, int components,
                               const std::string& pointer);
// The same for unsigned integers, which must not be normalized.
std::vector<uint32_t> read_integers(const Document& document, int accessor, int components,
                                    const std::string& pointer);
int component_count(const Document& document, int accessor, const std::string& pointer);
size_t element_count(const Document& document, int accessor, const std::string& pointer);
// Throws Error if the accessor has more elements than its data can hold.
void check_backed(const Document& document, int accessor, const std::string& pointer);

}  // namespace pssmlt::gltf
