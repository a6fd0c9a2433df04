#include "core/material_base.h"

namespace pssmlt {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class InvalidBsdf final : public Bsdf {
 public:
  Rgb eval(const vec3&, const vec3&, Transport) const override { return Rgb(nan); }
  float pdf(const vec3&, const vec3&) const override { return inv_pi; }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2&, Transport) const override {
    return BsdfSample{
        .wi = {-wo.x, -wo.y, wo.z}, .weight = Rgb(nan), .pdf = inv_pi, .pdf_reverse = inv_pi};
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return Rgb(nan); }
};

}  // namespace

const Bsdf* invalid_bsdf(BsdfStorage& storage) { return storage.make<InvalidBsdf>(); }

BumpedMaterial::BumpedMaterial(Parameters& p) {
  auto height = p.optional_float_texture(
      "displacement", "height field [m] that bends the shading normal, not the surface");
  const std::string map =
      p.file("normalmap", "image of shading normals, instead of \"displacement\"");
  const bool textured = p.has("normals");
  auto normals = p.rgb_texture("normals", Rgb(0.5f, 0.5f, 1.f), SpectrumUse::Unbounded, "",
                               "texture of shading normals n as (n + 1) / 2, not encoded");
  const float scale = p.number("normalscale", 1.f, "", "of \"normals\": factor of their slope");
  if (p.describing()) return;
  if (height && !map.empty())
    p.fail("normalmap", "\"normalmap\" cannot be given together with \"displacement\"");
  if (textured && (height || !map.empty()))
    p.fail("normals", "\"normals\" cannot be given together with another map");
  if (textured) shading_normals_ = bend_by_texture(std::move(normals), scale);
  if (height) shading_normals_ = bend_by_height(std::move(height));
  if (map.empty()) return;
  try {
    shading_normals_ = bend_by_map(map);
  } catch (const Error& e) {
    p.fail("normalmap", e.what());
  }
}

RoughnessTextures::RoughnessTextures(Parameters& p, const std::string& prefix) {
  const auto both =
      p.float_texture(prefix + "roughness", 0.f, "", "roughness along both axes; 0 is smooth");
  u_ = p.optional_float_texture(prefix + "uroughness", "roughness along dpdu; default: roughness");
  v_ = p.optional_float_texture(prefix + "vroughness", "roughness along dpdv; default: roughness");
  remap_ = p.flag("remaproughness", true, "the width of the lobe is the root of the roughness");
  if (!u_) u_ = both;
  if (!v_) v_ = both;
  if (!u_->constant() || !v_->constant()) return;
  if (u_->evaluate(Hit()) < 0.f || v_->evaluate(Hit()) < 0.f)
    p.fail("roughness must not be negative");
  constant_ = alpha(Hit());
  is_smooth_ = Ggx(constant_.x, constant_.y).is_smooth();
  is_constant_ = true;
}

float RoughnessTextures::width(float roughness) const {
  const float positive = clamp_keep_nan(roughness, infinity);
  return remap_ ? Ggx::remap(positive) : positive;
}

vec2 RoughnessTextures::alpha(const Hit& hit) const {
  if (is_constant_) return constant_;
  return {width(u_->evaluate(hit)), width(v_->evaluate(hit))};
}

}  // namespace pssmlt
