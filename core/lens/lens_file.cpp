#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/base/error.h"
#include "core/lens/lens_system.h"

namespace pssmlt {
namespace {

constexpr size_t most_surfaces = 1000;
constexpr double millimetre = 1e-3;

struct Number {
  double value = 0.0;
  Location where;
};

// Appends the numbers of a line.
void read_line(const std::string& line, Location where, std::vector<Number>& out) {
  const std::string text = line.substr(0, line.find('#'));
  constexpr const char* blanks = " \t\r\f\v,";
  for (size_t at = 0; (at = text.find_first_not_of(blanks, at)) != std::string::npos;) {
    const size_t end = std::min(text.find_first_of(blanks, at), text.size());
    const std::string word = text.substr(at, end - at);
    where.column = static_cast<uint32_t>(at + 1);
    char* rest = nullptr;
    const double value = std::strtod(word.c_str(), &rest);
    if (*rest != '\0' || !std::isfinite(value))
      throw Error(where, "a lens file has only numbers, not \"" + word + "\"");
    out.push_back({value, where});
    at = end;
  }
}

std::vector<Number> read_numbers(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path + ": cannot be read");
  Location where;
  where.file = std::make_shared<const std::string>(path);
  std::vector<Number> numbers;
  for (std::string line; std::getline(in, line);) {
    ++where.line;
    read_line(line, where, numbers);
    if (numbers.size() > 4 * most_surfaces)
      throw Error(where, fmt::format("more than {} surfaces", most_surfaces));
  }
  return numbers;
}

// One row; z is left at 0.
LensSurface surface(const Number* row) {
  LensSurface s;
  s.radius = row[0].value * millimetre;
  s.index = row[2].value == 0.0 ? 1.0 : row[2].value;
  s.opening = 0.5 * row[3].value * millimetre;
  if (row[1].value < 0.0) throw Error(row[1].where, "a thickness must not be negative");
  if (s.index < 1.0 || s.index > 10.0)
    throw Error(row[2].where, "a refractive index must lie between 1 and 10 (0: air)");
  if (!(s.opening > 0.0)) throw Error(row[3].where, "a diameter must be positive");
  return s;
}

}  // namespace

LensFile read_lens_file(const std::string& path) {
  const std::vector<Number> numbers = read_numbers(path);
  if (numbers.empty()) throw Error(path + ": the lens file has no surfaces");
  if (numbers.size() % 4 != 0) {
    throw Error(numbers.back().where,
                fmt::format("a lens file has four numbers for each surface, not {} in all",
                            numbers.size()));
  }
  LensFile lens;
  double z = 0.0;
  bool curved = false;
  for (size_t i = 0; i < numbers.size(); i += 4) {
    LensSurface s = surface(&numbers[i]);
    s.z = z;
    z -= numbers[i + 1].value * millimetre;
    lens.film_distance = numbers[i + 1].value * millimetre;
    lens.has_stop |= s.is_stop();
    curved |= !s.is_stop();
    lens.surfaces.push_back(s);
  }
  if (!curved) throw Error(path + ": the lens file has no curved surface");
  if (lens.surfaces.back().index != 1.0)
    throw Error(numbers[numbers.size() - 2].where, "the film must lie in air (index 1 or 0)");
  return lens;
}

}  // namespace pssmlt
