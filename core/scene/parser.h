// Reads scenes in pbrt-v4's text format (https://pbrt.org/fileformat-v4), with two extensions
// before WorldBegin: any sampler under any integrator, and layers
//   LayerBegin "name" <parameters>  Sampler ...  Integrator ...  LayerEnd
// whose images are summed. What a layer does not give is taken from the directives outside.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/description.h"
#include "core/scene/dialect.h"

namespace pssmlt {

// Files of other formats (core/scene/import.h) are read by their importers.
// Throws Error, with the place and the quoted line, on anything that is not a well-formed scene.
// Notes for the user (deprecated syntax and the like) are appended to log unless it is null.
SceneDescription parse_file(const std::string& path, std::vector<std::string>* log,
                            const ParseOptions& options = {});

// The same for text in memory; `name` stands for the file in messages. Include and Import are
// errors, and the file system is not touched, unless a directory is given to resolve them against.
SceneDescription parse_string(std::string_view text, const std::string& name,
                              const std::string& directory = "",
                              std::vector<std::string>* log = nullptr,
                              const ParseOptions& options = {});

}  // namespace pssmlt
