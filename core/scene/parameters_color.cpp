// The reads of Parameters that go through colour conversion and textures.
#include <array>
#include <charconv>

#include "core/color/spectrum_parameter.h"
#include "core/scene/parameters.h"
#include "core/texture.h"

namespace pssmlt {
namespace {

std::string shortest(float value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string shortest(const Rgb& c) {
  if (c.x == c.y && c.y == c.z) return shortest(c.x);
  return shortest(c.x) + " " + shortest(c.y) + " " + shortest(c.z);
}

}  // namespace

Rgb Parameters::rgb(std::string_view name, const Rgb& fallback, SpectrumUse use,
                    std::string_view unit, std::string_view doc) {
  document(name, "rgb, spectrum or blackbody", shortest(fallback), unit, doc);
  const Parameter* const p =
      find_one(name, {ParameterType::Rgb, ParameterType::Spectrum, ParameterType::Blackbody});
  return p != nullptr ? spectrum_to_rgb(*p, use, *resolver_) : fallback;
}

std::optional<std::vector<vec2>> Parameters::spectrum(std::string_view name, std::string_view unit,
                                                      std::string_view doc) {
  document(name, "spectrum or rgb", "", unit, doc);
  const Parameter* const p = find_one(name, {ParameterType::Spectrum, ParameterType::Rgb});
  if (p == nullptr || p->type != ParameterType::Spectrum) return std::nullopt;
  return spectrum_samples(*p, *resolver_);
}

std::shared_ptr<const Texture<float>> Parameters::float_texture(std::string_view name,
                                                                float fallback,
                                                                std::string_view unit,
                                                                std::string_view doc) {
  document(name, "float or texture", shortest(fallback), unit, doc);
  const Parameter* const p = find_one(name, {ParameterType::Float, ParameterType::Texture});
  if (p == nullptr) return constant_texture(fallback);
  if (p->type == ParameterType::Texture) return resolver_->float_texture(p->strings[0], p->where);
  return constant_texture(p->floats[0]);
}

std::shared_ptr<const Texture<float>> Parameters::optional_float_texture(std::string_view name,
                                                                         std::string_view doc) {
  document(name, "float or texture", "", "", doc);
  const Parameter* const p = find_one(name, {ParameterType::Float, ParameterType::Texture});
  if (p == nullptr) return nullptr;
  if (p->type == ParameterType::Texture) return resolver_->float_texture(p->strings[0], p->where);
  return constant_texture(p->floats[0]);
}

std::shared_ptr<const Texture<Rgb>> Parameters::rgb_texture(std::string_view name,
                                                            const Rgb& fallback, SpectrumUse use,
                                                            std::string_view unit,
                                                            std::string_view doc) {
  document(name, "rgb, spectrum, blackbody or texture", shortest(fallback), unit, doc);
  const Parameter* const p = find_one(name, {ParameterType::Rgb, ParameterType::Spectrum,
                                             ParameterType::Blackbody, ParameterType::Texture});
  if (p == nullptr) return constant_texture(fallback);
  if (p->type == ParameterType::Texture) return resolver_->rgb_texture(p->strings[0], p->where);
  return constant_texture(spectrum_to_rgb(*p, use, *resolver_));
}

}  // namespace pssmlt
