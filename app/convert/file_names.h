// Which values of a directive name files, and what they are called from another folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "core/scene/description.h"

namespace pssmlt {

class FileNames {
 public:
  // Names in the scene start at `from`, as Parameters::file resolves them; the new ones at `to`.
  FileNames(std::filesystem::path from, std::filesystem::path to);

  // The parameters of a directive of this kind and plugin ("shape", "plymesh"), with files named
  // as from the new folder, and without those that Attribute gave for others.
  ParameterSet moved(const std::string& kind, const Directive& directive);

 private:
  // Parameters of a plugin as it documents them, name to type; nullopt if there is none.
  using Docs = std::optional<std::map<std::string, std::string, std::less<>>>;
  const Docs& docs(const std::string& kind, const std::string& plugin);
  std::string moved(const std::string& name) const;
  bool exists(const std::string& name) const;

  std::filesystem::path from_, to_;
  bool same_;  // nothing moves
  std::map<std::pair<std::string, std::string>, Docs> docs_;
};

}  // namespace pssmlt
