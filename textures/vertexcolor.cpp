// The colours ("color") or opacities ("coloralpha") that a mesh gives its vertices, interpolated
// over its triangles; white and 1 on shapes that give none. Blind to emission: points that area
// lights draw on their shapes know no vertices.
#include <type_traits>

#include "core/plugin/plugin.h"
#include "core/texture.h"
#include "core/vertex_data.h"

namespace pssmlt {
namespace {

template <typename T>
class VertexColor final : public Texture<T> {
 public:
  static constexpr const char* summary = "colours or opacities of a mesh's vertices";

  explicit VertexColor(Parameters&) {}
  T evaluate(const Hit& hit) const override {
    if constexpr (std::is_same_v<T, float>) {
      return vertex_opacity(hit);
    } else {
      return vertex_color(hit);
    }
  }
  bool reads_derivatives() const override { return false; }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("vertexcolor", pssmlt::VertexColor)
