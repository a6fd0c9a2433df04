// The same value everywhere.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
class Constant final : public Texture<T> {
 public:
  static constexpr const char* summary = "the same value everywhere";

  explicit Constant(Parameters& p) : value_(plain_value<T>(p, "value", 1.f, "the value")) {}
  T evaluate(const Hit&) const override { return value_; }
  bool constant() const override { return true; }

 private:
  T value_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("constant", pssmlt::Constant)
