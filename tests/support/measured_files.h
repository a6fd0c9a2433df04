// Small files of measurements, written from a formula.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "core/base/rgb.h"
#include "core/measured/bilinear_warp.h"
#include "core/microfacet.h"

namespace pssmlt::test {

using Brdf = std::function<Rgb(const vec3& wo, const vec3& wi)>;  // [1/sr]

inline vec3 polar(float theta, float phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// The bytes of a tensor file; fields may be changed before they are written.
class TensorWriter {
 public:
  struct Field {
    std::string name;
    uint8_t type = 10;  // 32-bit floats
    std::vector<uint64_t> shape;
    std::string bytes;
  };
  void add(const std::string& name, std::vector<uint64_t> shape, const std::vector<float>& v) {
    fields.push_back({name, 10, std::move(shape), bytes_of(v.data(), v.size())});
  }
  void add_bytes(const std::string& name, const std::string& bytes) {
    fields.push_back({name, 1, {bytes.size()}, bytes});
  }
  Field& field(const std::string& name) { return *std::ranges::find(fields, name, &Field::name); }
  void drop(const std::string& name) {
    std::erase_if(fields, [&](const Field& f) { return f.name == name; });
  }
  // A number of a field of floats.
  void set(const std::string& name, size_t index, float value) {
    std::memcpy(field(name).bytes.data() + index * sizeof value, &value, sizeof value);
  }
  std::string bytes() const {
    std::string head("tensor_file\0", 12), data;
    put<uint8_t>(head, 1);
    put<uint8_t>(head, 0);
    put(head, static_cast<uint32_t>(fields.size()));
    uint64_t offset = head.size();
    for (const Field& f : fields) offset += 13 + f.name.size() + 8 * f.shape.size();
    for (const Field& f : fields) {
      put(head, static_cast<uint16_t>(f.name.size()));
      head += f.name;
      put(head, static_cast<uint16_t>(f.shape.size()));
      put(head, f.type);
      put(head, offset + data.size());
      for (const uint64_t n : f.shape) put(head, n);
      data += f.bytes;
    }
    return head + data;
  }
  std::vector<Field> fields;

  template <typename T>
  static std::string bytes_of(const T* values, size_t count) {
    return {reinterpret_cast<const char*>(values), count * sizeof(T)};
  }
  template <typename T>
  static void put(std::string& out, T value) {
    out += bytes_of(&value, 1);
  }
};

struct RglOptions {
  Ggx normals{0.5f, 0.5f};              // that the parameterisation follows
  std::vector<float> phi = {0.f};       // of wo
  std::vector<float> theta = {};        // default: eight, to the horizon
  std::vector<float> wavelengths = {};  // empty: rgb
  bool jacobian = true;
  int size = 32;  // nodes an axis
};

// The value of an RGB colour at a wavelength: three bands.
inline float band(const Rgb& c, float lambda) {
  return lambda < 500.f ? c.z : lambda < 600.f ? c.y : c.x;
}

// The tables of a tensor file that follow from a formula (Dupuy and Jakob 2018, section 4).
class RglTables {
 public:
  RglTables(const Brdf& f, const RglOptions& options) : f_(f), o_(options) {
    if (o_.theta.empty())
      for (int i = 0; i < 8; ++i)
        o_.theta.push_back(0.5f * pi * (static_cast<float>(i) + 0.1f) / 7.2f);
    parameterise();
    channels_ = o_.wavelengths.empty() ? 3 : o_.wavelengths.size();
    colours_.resize(grids() * channels_ * nodes());
    const BilinearWarp warp(visible_, o_.size, o_.size);
    for (size_t g = 0; g < grids(); ++g) measure(g, warp);
  }
  TensorWriter write() const {
    const auto n = static_cast<uint64_t>(o_.size), phis = o_.phi.size(), thetas = o_.theta.size();
    TensorWriter w;
    w.add_bytes("description", "a formula");
    w.add("phi_i", {phis}, o_.phi);
    w.add("theta_i", {thetas}, o_.theta);
    w.add("ndf", {n, n}, ndf_);
    w.add("sigma", {n, n}, sigma_);
    w.add("vndf", {phis, thetas, n, n}, visible_);
    w.add("luminance", {phis, thetas, n, n}, luminance_);
    const bool spectral = !o_.wavelengths.empty();
    if (spectral) w.add("wavelengths", {channels_}, o_.wavelengths);
    w.add(spectral ? "spectra" : "rgb", {phis, thetas, channels_, n, n}, colours_);
    w.add_bytes("jacobian", std::string(1, o_.jacobian ? '\1' : '\0'));
    return w;
  }

 private:
  size_t nodes() const { return static_cast<size_t>(o_.size) * static_cast<size_t>(o_.size); }
  size_t grids() const { return o_.phi.size() * o_.theta.size(); }
  vec2 node(size_t i) const {
    const auto n = static_cast<size_t>(o_.size);
    return vec2(static_cast<float>(i % n), static_cast<float>(i / n)) /
           static_cast<float>(o_.size - 1);
  }
  // Half vectors of isotropic files are relative to wo.
  float turn(float phi) const { return o_.phi.size() <= 2 ? phi : 0.f; }
  static vec3 direction(const vec2& u, float turn) {
    return polar(u.x * u.x * 0.5f * pi, (2.f * u.y - 1.f) * pi + turn);
  }
  // The projected area of all facets toward w, Smith's: cos / G1.
  float area(const vec3& w) const {
    const vec3 up(0.f, 0.f, 1.f);
    return o_.normals.d(up) / o_.normals.pdf_visible(w, up) * w.z;
  }

  void parameterise() {
    for (size_t i = 0; i < nodes(); ++i) {
      const vec2 u = node(i);
      ndf_.push_back(o_.normals.d(direction(u, 0.f)));
      sigma_.push_back(area(direction({std::min(u.x, 0.999f), u.y}, 0.f)));
    }
    for (const float phi : o_.phi)
      for (const float theta : o_.theta)
        for (size_t i = 0; i < nodes(); ++i) {
          const vec3 m = direction(node(i), turn(phi));
          const float x = node(i).x;
          visible_.push_back(std::max(glm::dot(polar(theta, phi), m), 0.f) * o_.normals.d(m) * x *
                             std::sin(x * x * 0.5f * pi));
        }
  }
  void measure(size_t g, const BilinearWarp& warp) {
    const float phi = o_.phi[g / o_.theta.size()], theta = o_.theta[g % o_.theta.size()];
    const vec3 wo = polar(theta, phi);
    const GridBlend blend = GridAxes(o_.phi, o_.theta).at(phi, theta);
    for (size_t i = 0; i < nodes(); ++i) {
      // Not quite at the edges, where maps of zeros cannot be undone.
      const vec2 u = glm::clamp(node(i), 1e-3f, 1.f - 1e-3f);
      const vec3 m = direction(warp.sample(blend, u).point, turn(phi));
      const vec3 wi = reflect(wo, m);
      // Continued below the horizon, so that the nodes there do not darken what is above it.
      const vec3 above = glm::normalize(vec3(wi.x, wi.y, std::max(wi.z, 1e-3f)));
      const float scale = o_.jacobian ? 4.f * area(wo) / o_.normals.d(m) : 1.f;
      const Rgb value = f_(wo, above) * (above.z * scale);
      luminance_.push_back(luminance(value));
      for (size_t c = 0; c < channels_; ++c)
        colours_[(g * channels_ + c) * nodes() + i] =
            o_.wavelengths.empty() ? value[static_cast<int>(c)] : band(value, o_.wavelengths[c]);
    }
  }

  const Brdf& f_;
  RglOptions o_;
  size_t channels_ = 3;
  std::vector<float> ndf_, sigma_, visible_, luminance_, colours_;
};

inline TensorWriter tensor_file(const Brdf& f, const RglOptions& options = {}) {
  return RglTables(f, options).write();
}

// f as a MERL table, at the middles of its cells; -1 where a direction is below the horizon.
inline std::string merl_file(const Brdf& f, std::array<int, 3> counts = {45, 30, 36}) {
  std::string bytes = TensorWriter::bytes_of(counts.data(), 3);
  const double scales[] = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
  for (int c = 0; c < 3; ++c)
    for (int h = 0; h < counts[0]; ++h)
      for (int d = 0; d < counts[1]; ++d)
        for (int p = 0; p < counts[2]; ++p) {
          const auto part = [](int i, int n) {
            return (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
          };
          const float theta_h = 0.5f * pi * sqr(part(h, counts[0]));
          const vec3 diff = polar(0.5f * pi * part(d, counts[1]), pi * part(p, counts[2]));
          const float s = std::sin(theta_h), k = std::cos(theta_h);
          const auto turned = [&](const vec3& v) {
            return vec3(k * v.x + s * v.z, v.y, k * v.z - s * v.x);
          };
          const vec3 wi = turned(diff), wo = turned({-diff.x, -diff.y, diff.z});
          const bool above = wi.z > 0.f && wo.z > 0.f;
          TensorWriter::put(bytes, above ? static_cast<double>(f(wo, wi)[c]) / scales[c] : -1.0);
        }
  return bytes;
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace pssmlt::test
