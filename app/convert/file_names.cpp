#include "app/convert/file_names.h"

#include <utility>

#include "core/color/named_spectra.h"
#include "core/plugin/registry.h"

namespace pssmlt {
namespace fs = std::filesystem;

FileNames::FileNames(fs::path from, fs::path to) : from_(std::move(from)), to_(std::move(to)) {
  std::error_code ignored;
  if (from_.empty()) from_ = ".";
  if (to_.empty()) to_ = ".";
  same_ = fs::equivalent(from_, to_, ignored);
}

const FileNames::Docs& FileNames::docs(const std::string& kind, const std::string& plugin) {
  const auto [entry, added] = docs_.try_emplace({kind, plugin});
  if (!added) return entry->second;
  try {
    const FoundPlugin found = Registry::instance().find(kind, plugin, {});
    Docs documented;
    documented.emplace();
    for (const ParameterDoc& doc : describe(*found.descriptor))
      documented->emplace(doc.name, doc.type);
    entry->second = std::move(documented);
  } catch (const Error&) {
    // A plugin that is not there: what looks like a file is taken for one.
  }
  return entry->second;
}

std::string FileNames::moved(const std::string& name) const {
  if (same_ || name.empty() || fs::path(name).is_absolute()) return name;
  std::error_code failed;
  const fs::path relative = fs::relative(from_ / name, to_, failed);
  if (!failed && !relative.empty()) return relative.string();
  return fs::absolute(from_ / name, failed).string();
}

bool FileNames::exists(const std::string& name) const {
  std::error_code ignored;
  return !name.empty() && fs::is_regular_file(from_ / name, ignored);
}

ParameterSet FileNames::moved(const std::string& kind, const Directive& directive) {
  const Docs& known = docs(kind, directive.type);
  ParameterSet result;
  for (const Parameter& original : directive.parameters) {
    const bool documented = known && known->contains(original.name);
    // Every shape has an alpha, whatever its plugin reads.
    if (original.was_read && known && !documented && original.name != "alpha") continue;
    Parameter p = original;
    if (p.type == ParameterType::String) {
      const bool is_file = documented ? known->find(p.name)->second.starts_with("string: file")
                                      : p.strings.size() == 1 && exists(p.strings[0]);
      for (std::string& name : p.strings)
        if (is_file) name = moved(name);
    }
    if (p.type == ParameterType::Spectrum) {
      for (std::string& name : p.strings)
        if (!named_spectrum(name)) name = moved(name);
    }
    result.push_back(std::move(p));
  }
  return result;
}

}  // namespace pssmlt
