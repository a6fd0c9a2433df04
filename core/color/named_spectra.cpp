#include "core/color/named_spectra.h"

#include "core/color/named_data.h"

namespace pssmlt {
namespace {

const std::vector<named_data::Entry>& entries() {
  static const std::vector<named_data::Entry> all = [] {
    std::vector<named_data::Entry> list;
    for (const auto& part : {named_data::metals(), named_data::glasses(), named_data::illuminants(),
                             named_data::fluorescent_lamps()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

}  // namespace

std::optional<Samples> named_spectrum(std::string_view name) {
  for (const named_data::Entry& entry : entries())
    if (entry.name == name) return entry.make();
  return std::nullopt;
}

const std::vector<std::string>& named_spectrum_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const named_data::Entry& entry : entries()) list.emplace_back(entry.name);
    return list;
  }();
  return names;
}

}  // namespace pssmlt
