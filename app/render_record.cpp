#include "app/render_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>
#include <sstream>

namespace pssmlt {
namespace {

std::optional<std::string> find(const ImageMetadata& metadata, const std::string& key) {
  for (const auto& [name, value] : metadata) {
    if (name == key) return value;
  }
  return std::nullopt;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool fine = error == std::errc() && end == text.data() + text.size();
  return fine && std::isfinite(value) && value >= 0.0 ? std::optional(value) : std::nullopt;
}

std::string error_text(const RenderRecord& r) {
  const std::optional<RelativeError>& e = r.error;
  if (e) return fmt::format("relMSE {:.6g} ({:.6g} to {:.6g})", e->value, e->low, e->high);
  return r.unknown_error.empty() ? "unknown" : "unknown (" + r.unknown_error + ")";
}

std::optional<RelativeError> read_error(const std::string& text) {
  static const std::regex pattern(R"(relMSE (\S+) \((\S+) to (\S+)\))");
  std::smatch match;
  if (!std::regex_match(text, match, pattern)) return std::nullopt;
  const auto value = number(match[1]), low = number(match[2]), high = number(match[3]);
  if (!value || !low || !high || *low > *high) return std::nullopt;
  return RelativeError{*value, *low, *high};
}

// "hash:seed hash:seed ..."
std::string parts_text(const std::vector<RenderPart>& parts) {
  std::string text;
  for (const RenderPart& p : parts) {
    text += (text.empty() ? "" : " ") + p.settings_hash + ":" + p.seed;
  }
  return text;
}

std::vector<RenderPart> read_parts(const std::string& text) {
  std::vector<RenderPart> parts;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t colon = word.find(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == word.size()) return {};
    parts.push_back({word.substr(0, colon), word.substr(colon + 1)});
  }
  return parts;
}

// Each once, in the order of the parts.
std::string joined(const std::vector<RenderPart>& parts, std::string RenderPart::*member) {
  std::vector<std::string> seen;
  for (const RenderPart& p : parts) {
    if (std::ranges::find(seen, p.*member) == seen.end()) seen.push_back(p.*member);
  }
  std::string text;
  for (const std::string& s : seen) text += (text.empty() ? "" : ", ") + s;
  return text;
}

}  // namespace

bool RenderRecord::one_technique() const {
  return std::ranges::all_of(parts, [this](const RenderPart& p) {
    return p.settings_hash == parts.front().settings_hash;
  });
}

RenderRecord make_record(const std::string& scene_path, const BuiltScene& scene, uint64_t seed,
                         const RenderResult& result) {
  RenderRecord r;
  r.scene = scene_path;
  r.scene_hash = fmt::format("{:016x}", scene.scene_hash);
  r.picture_hash = fmt::format("{:016x}", scene.picture_hash);
  for (const Layer& layer : scene.layers) {
    r.integrator += (r.integrator.empty() ? "" : " + ") + layer.integrator_name;
    r.sampler += (r.sampler.empty() ? "" : " + ") + layer.sampler_name;
  }
  r.parts = {{fmt::format("{:016x}", scene.settings_hash), std::to_string(seed)}};
  r.samples = result.samples;
  r.seconds = result.seconds;
  const ErrorEstimate& e = result.error;
  if (e.known) {
    r.error = RelativeError{e.relative_mse, e.low, e.high};
  } else {
    r.unknown_error = e.why;
  }
  return r;
}

ImageMetadata to_metadata(const RenderRecord& r) {
  ImageMetadata data = {{"software", "pssmlt " PSSMLT_VERSION},
                        {"pssmlt:scene", r.scene},
                        {"pssmlt:scene_hash", r.scene_hash},
                        {"pssmlt:picture_hash", r.picture_hash},
                        {"pssmlt:settings_hash", joined(r.parts, &RenderPart::settings_hash)},
                        {"pssmlt:integrator", r.integrator},
                        {"pssmlt:sampler", r.sampler},
                        {"pssmlt:seed", joined(r.parts, &RenderPart::seed)},
                        {"pssmlt:samples", fmt::format("{:.0f}", r.samples)},
                        {"pssmlt:seconds", fmt::format("{:.3f}", r.seconds)},
                        {"pssmlt:error", error_text(r)}};
  if (r.parts.size() > 1) data.emplace_back("pssmlt:merged", parts_text(r.parts));
  return data;
}

std::optional<RenderRecord> read_record(const ImageMetadata& metadata) {
  const auto text = [&](const char* key) { return find(metadata, key).value_or(""); };
  RenderRecord r;
  r.scene = text("pssmlt:scene");
  r.scene_hash = text("pssmlt:scene_hash");
  r.picture_hash = text("pssmlt:picture_hash");
  r.integrator = text("pssmlt:integrator");
  r.sampler = text("pssmlt:sampler");
  const std::optional<std::string> merged = find(metadata, "pssmlt:merged");
  r.parts = read_parts(merged ? *merged : text("pssmlt:settings_hash") + ":" + text("pssmlt:seed"));
  const auto samples = number(text("pssmlt:samples"));
  if (r.scene_hash.empty() || r.picture_hash.empty() || r.parts.empty()) return std::nullopt;
  if (!samples || *samples <= 0.0) return std::nullopt;
  r.samples = *samples;
  r.seconds = number(text("pssmlt:seconds")).value_or(0.0);
  r.error = read_error(text("pssmlt:error"));
  return r;
}

}  // namespace pssmlt
