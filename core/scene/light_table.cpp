#include "core/scene/light_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pssmlt {
namespace {

// An infinite sum would leave every finite light without a share.
double finite_power(const Light& light) {
  return std::min(static_cast<double>(light.power()),
                  static_cast<double>(std::numeric_limits<float>::max()));
}

bool is_bounded(const LightBounds& b) {
  return is_finite(b.box.min) && is_finite(b.box.max) && b.intensity > 0.f;
}

}  // namespace

LightIndex::LightIndex(const std::vector<const Light*>& lights) {
  slots_.resize(std::bit_ceil(2 * lights.size() + 1));
  mask_ = slots_.size() - 1;
  for (size_t i = 0; i < lights.size(); ++i) {
    if (find(lights[i])) continue;
    size_t slot = first_slot(lights[i]);
    while (slots_[slot].light) slot = (slot + 1) & mask_;
    slots_[slot] = {lights[i], i};
  }
}

LightTable::LightTable(const std::vector<const Light*>& lights, const SceneBounds& bounds) {
  std::vector<double> power;
  for (const Light* light : lights) {
    const double p = finite_power(*light);
    if (!(p > 0.0)) continue;
    lights_.push_back(light);
    power.push_back(p);
    const EndpointTraits traits = light->traits();
    if (traits.infinite && !traits.delta_direction) infinite_.push_back(light);
  }
  index_ = LightIndex(lights_);
  set_probabilities(power);
  if (lights_.size() >= many) build_tree(power, bounds);
}

void LightTable::set_probabilities(const std::vector<double>& power) {
  double total = 0.0;
  for (const double p : power) total += p;
  double sum = 0.0;
  for (const double p : power) {
    sum += 0.9 * p / total + 0.1 / static_cast<double>(power.size());
    // Few lights are chosen by the upper bits of the number alone, for which float is enough.
    cdf_.push_back(power.size() < many ? static_cast<double>(static_cast<float>(sum)) : sum);
  }
  // What choose() does is the truth: probabilities are the differences of the rounded sums.
  if (!cdf_.empty()) cdf_.back() = 1.0;
  for (size_t i = 0; i < cdf_.size(); ++i)
    probability_.push_back(static_cast<float>(i == 0 ? cdf_[0] : cdf_[i] - cdf_[i - 1]));
}

void LightTable::build_tree(const std::vector<double>& power, const SceneBounds& bounds) {
  std::vector<LightBounds> content;
  std::vector<double> outside;
  for (size_t i = 0; i < lights_.size(); ++i) {
    auto b = lights_[i]->bounds();
    const bool inside = b && is_bounded(*b);
    in_tree_.push_back(inside);
    place_.push_back(static_cast<uint32_t>(inside ? inside_.size() : outside_.size()));
    (inside ? inside_ : outside_).push_back(i);
    if (inside) {
      b->intensity = std::min(b->intensity, 1e30f);  // sums stay finite
      content.push_back(*b);
    } else {
      outside.push_back(static_cast<double>(probability_[i]));
      outside_irradiance_ +=
          power[i] / (std::numbers::pi * sqr(static_cast<double>(bounds.radius)));
    }
  }
  if (content.size() < many) return;
  tree_ = LightTree(content);
  outside_power_ = Distribution1D(std::span<const double>(outside));
}

size_t LightTable::index_of(double u) const {
  if (lights_.size() < many) u = std::floor(u * 0x1p24) * 0x1p-24;
  return static_cast<size_t>(std::upper_bound(cdf_.begin(), cdf_.end() - 1, u) - cdf_.begin());
}

LightTable::Choice LightTable::choose(double u) const {
  if (lights_.empty()) return {};
  const size_t i = index_of(u);
  return {lights_[i], probability_[i], probability_[i]};
}

float LightTable::probability(const Light* light) const {
  const auto found = index_.find(light);
  return found ? probability_[*found] : 0.f;
}

LightTable::Choice LightTable::choose(LightPick pick, const LightReceiver& at, double u) const {
  if (by_place(pick)) return choose_by_place(at, u);
  if (pick != LightPick::uniform || lights_.empty()) return choose(u);
  const auto n = static_cast<double>(lights_.size());
  const auto i = static_cast<size_t>(u * n);
  return {lights_[i], static_cast<float>(1.0 / n), probability_[i]};
}

float LightTable::probability(LightPick pick, const LightReceiver& at, const Light* light) const {
  if (pick == LightPick::power || (pick == LightPick::bvh && tree_.empty()))
    return probability(light);
  const auto found = index_.find(light);
  if (!found) return 0.f;
  if (pick == LightPick::uniform)
    return static_cast<float>(1.0 / static_cast<double>(lights_.size()));
  return static_cast<float>(probability_by_place(at, *found));
}

// A part of u decides each question, what is left of it the next one.
LightTable::Choice LightTable::choose_by_place(const LightReceiver& at, double u) const {
  size_t i = 0;
  if (u < defence) {
    i = index_of(u / defence);
    return {lights_[i], static_cast<float>(probability_by_place(at, i)), probability_[i]};
  }
  constexpr double below_one = 1.0 - 0x1p-53;
  u = std::min((u - defence) / (1.0 - defence), below_one);
  const double outside = outside_share(at);
  double p = 0.0;
  if (u < outside) {
    const auto cell = outside_power_.sample(u / outside);
    i = outside_[cell.index];
    p = outside * cell.probability;
  } else {
    const auto c = tree_.choose(at, std::min((u - outside) / (1.0 - outside), below_one));
    i = inside_[c.light];
    p = (1.0 - outside) * c.probability;
  }
  p = defence * static_cast<double>(probability_[i]) + (1.0 - defence) * p;
  return {lights_[i], static_cast<float>(p), probability_[i]};
}

double LightTable::probability_by_place(const LightReceiver& at, size_t light) const {
  const double outside = outside_share(at);
  const double p = in_tree_[light] ? (1.0 - outside) * tree_.probability(at, place_[light])
                                   : outside * outside_power_.probability(place_[light]);
  return defence * static_cast<double>(probability_[light]) + (1.0 - defence) * p;
}

// Neither side is ever starved: both irradiances are guesses.
double LightTable::outside_share(const LightReceiver& at) const {
  if (outside_.empty()) return 0.0;
  const double inside = tree_.irradiance(at);
  const double share = outside_irradiance_ / (outside_irradiance_ + inside);
  return std::isfinite(share) ? std::clamp(share, 0.1, 0.9) : 0.5;
}

}  // namespace pssmlt
