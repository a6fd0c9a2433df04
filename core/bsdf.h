// Scattering at a surface point, in its local shading frame (z is the shading normal).
#pragma once

#include <cstddef>
#include <new>
#include <optional>
#include <type_traits>

#include "core/base/rgb.h"

namespace pssmlt {

// What flows along wi -> wo: radiance (wo toward the camera) or importance (wo toward the light,
// light subpaths). Only non-symmetric scattering (refraction) depends on it (Veach 1997, ch. 5).
enum class Transport : uint8_t { radiance, importance };

class DiffusionProfile;

struct BsdfSample {
  vec3 wi{0.f};             // sampled direction, unit, local
  Rgb weight{0.f};          // f |cos| / pdf [1]; for delta lobes f's factor / probability
  float pdf = 0.f;          // [1/sr]; delta: probability of the lobe [1]
  float pdf_reverse = 0.f;  // of sampling wo given wi, same measure
  bool delta = false;
  bool transmitted = false;
  float eta = 1.f;  // ratio of indices seen by a transmitted ray, for roulette
  // Not null: the path goes on beneath the surface and leaves it at another point, by this profile
  // (core/path/way_beneath.h); wi means nothing then, pdf is a probability and pdf_reverse the
  // density [1/sr] of leaving toward wo.
  const DiffusionProfile* beneath = nullptr;
};

// Deterministic once made: everything random about the material was drawn by Material::bsdf.
// eval and pdf ignore delta lobes; pdf is the density that sample() has, delta lobes excluded.
class Bsdf {
 public:
  // f(wo, wi) [1/sr], no cosine. Zero where the two are on sides that no lobe connects.
  virtual Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const = 0;
  // Density of sample(wo) at wi [1/sr].
  virtual float pdf(const vec3& wo, const vec3& wi) const = 0;
  // What a connection needs: eval, pdf(wo, wi) and pdf(wi, wo); all zero where eval is black. The
  // quickest Bsdfs answer in one call.
  struct BothWays {
    Rgb f{0.f};
    float pdf = 0.f, pdf_reverse = 0.f;
  };
  virtual BothWays both_ways(const vec3& wo, const vec3& wi, Transport mode) const {
    BothWays v;
    v.f = eval(wo, wi, mode);
    if (is_black(v.f)) return v;
    v.pdf = pdf(wo, wi);
    v.pdf_reverse = pdf(wi, wo);
    return v;
  }
  // Uses u_lobe and u (all in [0,1)); nullopt where sampling fails (absorbed, below horizon).
  virtual std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                           Transport mode) const = 0;
  // True if eval can be non-zero, i.e. the vertex can be connected.
  virtual bool connectible() const = 0;
  // Hemispherical albedo estimate toward wo [1], for auxiliary images only.
  virtual Rgb albedo(const vec3& wo) const = 0;

 protected:
  ~Bsdf() = default;  // lives in BsdfStorage and is trivially dropped
};

// Room for one Bsdf inside a vertex; no allocation. Bsdfs must be trivially destructible.
class BsdfStorage {
 public:
  template <typename B, typename... Args>
  const Bsdf* make(Args&&... args) {
    static_assert(sizeof(B) <= sizeof(bytes_), "Bsdf too large for its storage");
    static_assert(std::is_trivially_destructible_v<B>, "nobody calls its destructor");
    return ::new (static_cast<void*>(bytes_)) B(static_cast<Args&&>(args)...);
  }

 private:
  alignas(16) std::byte bytes_[256];
};

}  // namespace pssmlt
