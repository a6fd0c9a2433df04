#include "core/scene/builder_media.h"

#include <algorithm>

namespace pssmlt {

const Medium* MediaBuilder::medium(const std::string& name, const Location& where) {
  if (name.empty()) return nullptr;
  return add(resolver_.medium(name, where));
}

const Medium* MediaBuilder::add(std::shared_ptr<const Medium> made) {
  const bool known = std::ranges::any_of(media_, [&](const auto& m) { return m == made; });
  if (!known) {
    media_.push_back(made);
    const MediumTraits traits = made->traits();
    features_.media = true;
    features_.emitting_media |= traits.emits;
    features_.connectible |= traits.scatters;
  }
  return made.get();
}

MediumInterface MediaBuilder::sides(const ShapeDescription& shape, const Material& material) {
  const Medium* const outside = medium(shape.outside_medium, shape.where);
  const auto own = material.interior();
  if (!own) return {medium(shape.inside_medium, shape.where), outside};
  if (!shape.inside_medium.empty() && shape.inside_medium != shape.outside_medium) {
    throw Error(shape.where, "the material brings the medium inside: \"" + shape.inside_medium +
                                 "\" cannot be inside as well");
  }
  return {add(own), outside};
}

const MediumInterface* MediaBuilder::around(const ShapeDescription& shape,
                                            const Material& material) {
  const MediumInterface both = sides(shape, material);
  if (both.inside == both.outside) return nullptr;
  const MediumInterface*& known = known_[{both.inside, both.outside}];
  if (!known) {
    interfaces_.push_back(std::make_unique<const MediumInterface>(both));
    known = interfaces_.back().get();
  }
  return known;
}

}  // namespace pssmlt
