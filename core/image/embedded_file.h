// Image files that lie inside other files (glTF): they have a name, which scenes use as that of a
// file, and bytes in memory. Who embeds a file keeps it as long as the name may be used.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace pssmlt {

struct EmbeddedFile {
  std::string name;
  std::string ending;  // of its format, without a dot: "png", "jpg", ...
  std::vector<unsigned char> bytes;
};

// Another file of the same name is replaced for those who ask from now on.
std::shared_ptr<const EmbeddedFile> embed_file(EmbeddedFile file);
// Null if there is none, or nobody keeps it any more.
std::shared_ptr<const EmbeddedFile> find_embedded_file(const std::string& name);

}  // namespace pssmlt
