// Media and what they surround, made when something in the scene first needs them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/medium.h"
#include "core/scene/builder_resolver.h"
#include "core/scene/features.h"

namespace pssmlt {

class MediaBuilder {
 public:
  MediaBuilder(BuildResolver& resolver, SceneFeatures& features)
      : resolver_(resolver), features_(features) {}

  // By name, "" is vacuum: null. Throws Error at `where`.
  const Medium* medium(const std::string& name, const Location& where);
  // What is on both sides of the shape, which is made of `material`; null if it separates nothing.
  // Throws Error where shape and material both say what is inside.
  const MediumInterface* around(const ShapeDescription& shape, const Material& material);
  // What light that starts on the shape enters.
  MediumInterface sides(const ShapeDescription& shape, const Material& material);

  std::vector<std::shared_ptr<const Medium>> take_media() { return std::move(media_); }
  std::vector<std::unique_ptr<const MediumInterface>> take_interfaces() {
    return std::move(interfaces_);
  }

 private:
  const Medium* add(std::shared_ptr<const Medium> made);
  BuildResolver& resolver_;
  SceneFeatures& features_;
  std::vector<std::shared_ptr<const Medium>> media_;
  std::vector<std::unique_ptr<const MediumInterface>> interfaces_;
  std::map<std::pair<const Medium*, const Medium*>, const MediumInterface*> known_;
};

}  // namespace pssmlt
