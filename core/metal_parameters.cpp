#include "core/metal_parameters.h"

#include "core/color/named_spectra.h"
#include "core/color/spectrum.h"
#include "core/material_base.h"

namespace pssmlt {
namespace {

// The colour of a spectrum that multiplies nothing in particular: lit by D65.
Rgb mean_rgb(std::string_view name) {
  const Samples samples = *named_spectrum(name);
  return Rgb(reflectance_rgb([&](double l) { return evaluate(samples, l, Outside::Clamp); }));
}

constexpr const char* default_eta = "metal-Cu-eta";
constexpr const char* default_k = "metal-Cu-k";

}  // namespace

Metal::Metal(Parameters& p, const std::string& prefix, float outside)
    : outside_(outside), curve_(read_curve(p, prefix)) {}

FresnelCurve Metal::read_curve(Parameters& p, const std::string& prefix) {
  const bool has_index = p.has(prefix + "eta") || p.has(prefix + "k");
  if (p.has("reflectance") && has_index)
    p.fail("reflectance", "\"reflectance\" excludes \"" + prefix + "eta\" and \"" + prefix + "k\"");
  const bool given = p.has("reflectance");
  const auto reflectance = p.rgb_texture("reflectance", Rgb(0.f), SpectrumUse::Albedo, "",
                                         "reflectance at normal incidence, instead of eta and k");
  if (!given) return read_index(p, prefix);
  if (!reflectance->constant()) reflectance_ = reflectance;
  const Rgb value = reflectance_ ? Rgb(0.f) : clamp_reflectance(reflectance->evaluate(Hit()));
  return FresnelCurve::from_reflectance(value, outside_);
}

FresnelCurve Metal::read_index(Parameters& p, const std::string& prefix) const {
  const std::string eta_name = prefix + "eta", k_name = prefix + "k";
  for (const std::string& name : {eta_name, k_name}) {
    if (p.type(name) == ParameterType::Texture) p.fail(name, "textures are not supported here yet");
  }
  constexpr const char* eta_doc = "refractive index; default: metal-Cu-eta";
  constexpr const char* k_doc = "extinction coefficient; default: metal-Cu-k";
  const auto is_rgb = [&p](const std::string& name) { return p.type(name) == ParameterType::Rgb; };
  if (!is_rgb(eta_name) && !is_rgb(k_name)) {
    const auto eta = p.spectrum(eta_name, "", eta_doc);
    const auto k = p.spectrum(k_name, "", k_doc);
    return FresnelCurve::from_spectra(eta ? *eta : *named_spectrum(default_eta),
                                      k ? *k : *named_spectrum(default_k), outside_);
  }
  const Rgb eta = p.rgb(eta_name, mean_rgb(default_eta), SpectrumUse::Unbounded, "", eta_doc);
  const Rgb k = p.rgb(k_name, mean_rgb(default_k), SpectrumUse::Unbounded, "", k_doc);
  return FresnelCurve::from_rgb(eta, k, outside_);
}

std::optional<MetalReflectance> Metal::at(const Hit& hit) const {
  if (!reflectance_) return MetalReflectance{&curve_};
  const Rgb value = clamp_reflectance(reflectance_->evaluate(hit));
  if (!is_finite(value)) return std::nullopt;
  return MetalReflectance{nullptr, 1.f / outside_, conductor_k_from_reflectance(value) / outside_};
}

}  // namespace pssmlt
