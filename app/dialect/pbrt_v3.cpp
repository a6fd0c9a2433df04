#include "app/dialect/pbrt_v3.h"

#include <algorithm>

#include "app/dialect/translation.h"

namespace pssmlt {
namespace {

void translate(SceneDescription& scene, const std::vector<OldSyntax>& syntax,
               std::vector<std::string>* log) {
  const bool old = std::ranges::any_of(syntax, &OldSyntax::sign) || v3::has_old_names(scene);
  if (!old && !syntax.empty()) throw Error(syntax[0].where, syntax[0].what);
  v3::Translation t(scene, old);
  v3::translate_options(t);
  v3::translate_textures(t);
  v3::translate_materials(t);
  v3::translate_media(t);
  v3::translate_lights(t);
  v3::translate_shapes(t);
  if (log == nullptr) return;
  for (std::string& line : t.report()) log->push_back(std::move(line));
}

}  // namespace

namespace v3 {

void Translation::translated(const std::string& kind, const std::string& name) {
  Done& done = done_[kind];
  ++done.count;
  done.names.insert(name);
}

static std::string joined(const std::set<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::vector<std::string> Translation::report() const {
  std::string line;
  for (const auto& [kind, done] : done_) {
    const std::string many = kind == "medium" ? "media" : kind + "s";
    line += (line.empty() ? "" : "; ") + std::to_string(done.count) + " " +
            (done.count == 1 ? kind : many) + " (" + joined(done.names) + ")";
  }
  std::vector<std::string> lines;
  if (old || !line.empty()) {
    lines.push_back("v3 dialect: " + (line.empty() ? "only the syntax is old" : line));
  }
  if (!dropped_.empty()) {
    lines.push_back("v3 dialect: without counterpart here, left out: " + joined(dropped_));
  }
  return lines;
}

}  // namespace v3

const Dialect& pbrt_v3() {
  static const Dialect dialect{&translate};
  return dialect;
}

}  // namespace pssmlt
