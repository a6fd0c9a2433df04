#include "core/image/embedded_file.h"

#include <map>
#include <mutex>

namespace pssmlt {
namespace {

struct Table {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<const EmbeddedFile>> files;
};

Table& table() {
  static Table t;
  return t;
}

}  // namespace

std::shared_ptr<const EmbeddedFile> embed_file(EmbeddedFile file) {
  auto kept = std::make_shared<const EmbeddedFile>(std::move(file));
  const std::lock_guard lock(table().mutex);
  std::erase_if(table().files, [](const auto& entry) { return entry.second.expired(); });
  table().files[kept->name] = kept;
  return kept;
}

std::shared_ptr<const EmbeddedFile> find_embedded_file(const std::string& name) {
  const std::lock_guard lock(table().mutex);
  const auto found = table().files.find(name);
  return found == table().files.end() ? nullptr : found->second.lock();
}

}  // namespace pssmlt
