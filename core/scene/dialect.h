// What lets scenes in an older form of the format be read. The parser knows the old syntax and no
// plugin; old names of plugins and parameters are put right afterwards, in the description, by
// whoever knows them (the command does, app/dialect).
#pragma once

#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pssmlt {

// What today's format does not have: what it was, and where it stood.
struct OldSyntax {
  std::string what;
  Location where;
  // A sign that the scene is old. False: `what` is the message of an error unless it is old.
  bool sign = true;
};

struct Dialect {
  // Translates a description in place, after all of it was read. `syntax` is empty if the text is
  // in today's syntax throughout; names may be old all the same. A description without anything
  // old must come out as it went in. Throws Error at what cannot be translated.
  void (*translate)(SceneDescription& scene, const std::vector<OldSyntax>& syntax,
                    std::vector<std::string>* log) = nullptr;
};

// How a text is read.
struct ParseOptions {
  const Dialect* dialect = nullptr;  // null: old syntax is an error
  bool keep_steps = false;           // TransformPair::steps, for whoever writes the scene again
};

}  // namespace pssmlt
