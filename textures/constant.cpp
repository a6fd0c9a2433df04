// The same value everywhere.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
T read_value(Parameters& p) {
  if constexpr (std::is_same_v<T, float>) {
    return p.number("value", 1.f, "", "the value");
  } else {
    return p.rgb("value", Rgb(1.f), SpectrumUse::Unbounded, "", "the value");
  }
}

template <typename T>
class Constant final : public Texture<T> {
 public:
  static constexpr const char* summary = "the same value everywhere";

  explicit Constant(Parameters& p) : value_(read_value<T>(p)) {}
  T evaluate(const Hit&) const override { return value_; }
  bool constant() const override { return true; }

 private:
  T value_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("constant", pssmlt::Constant)
