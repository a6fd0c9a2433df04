#include "core/path/witness.h"

#include <cmath>

namespace pssmlt {
namespace {

thread_local Witness* of_this_thread = nullptr;

// More than any scattering function or lamp that is meant.
constexpr float most = 1e36f;

bool can_be(float x) { return x >= 0.f && x <= most; }

}  // namespace

std::atomic<int> Witness::alive_{0};

Witness::Witness() {
  of_this_thread = this;
  alive_.fetch_add(1, std::memory_order_relaxed);
}

Witness::~Witness() {
  alive_.fetch_sub(1, std::memory_order_relaxed);
  of_this_thread = nullptr;
}

Witness* Witness::find() { return of_this_thread; }

const Bsdf* Witness::watch(const Bsdf& bsdf, const PluginNamed& plugin) {
  return &watched_.emplace_back(bsdf, plugin, *this);
}

void Witness::look_at(const Rgb& value, const PluginNamed& plugin) {
  if (!can_be(value.x) || !can_be(value.y) || !can_be(value.z)) accuse(plugin);
}

void Witness::look_at(float density, const PluginNamed& plugin) {
  // A density may be as large as a float: that of a lobe that is all but a mirror.
  if (!(density >= 0.f) || std::isinf(density)) accuse(plugin);
}

void Witness::accuse(const PluginNamed& plugin) {
  if (culprit_.empty()) culprit_ = plugin.plugin_name();
}

template <typename F>
auto Witness::WatchedBsdf::answer(const F& ask) const {
  try {
    return ask();
  } catch (...) {
    witness_.accuse(plugin_);
    throw;
  }
}

Rgb Witness::WatchedBsdf::eval(const vec3& wo, const vec3& wi, Transport mode) const {
  const Rgb f = answer([&] { return bsdf_.eval(wo, wi, mode); });
  witness_.look_at(f, plugin_);
  return f;
}

float Witness::WatchedBsdf::pdf(const vec3& wo, const vec3& wi) const {
  const float density = answer([&] { return bsdf_.pdf(wo, wi); });
  witness_.look_at(density, plugin_);
  return density;
}

Bsdf::BothWays Witness::WatchedBsdf::both_ways(const vec3& wo, const vec3& wi,
                                               Transport mode) const {
  const BothWays v = answer([&] { return bsdf_.both_ways(wo, wi, mode); });
  witness_.look_at(v.f, plugin_);
  witness_.look_at(v.pdf, plugin_);
  witness_.look_at(v.pdf_reverse, plugin_);
  return v;
}

std::optional<BsdfSample> Witness::WatchedBsdf::sample(const vec3& wo, float u_lobe, const vec2& u,
                                                       Transport mode) const {
  const auto s = answer([&] { return bsdf_.sample(wo, u_lobe, u, mode); });
  if (!s) return s;
  witness_.look_at(s->weight, plugin_);
  witness_.look_at(s->pdf, plugin_);
  witness_.look_at(s->pdf_reverse, plugin_);
  const float length2 = length_squared(s->wi);
  if (s->beneath == nullptr && !(std::abs(length2 - 1.f) < 0.1f)) witness_.accuse(plugin_);
  return s;
}

}  // namespace pssmlt
