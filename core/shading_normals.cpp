#include "core/shading_normals.h"

#include "core/base/error.h"
#include "core/image/mipmap.h"

namespace pssmlt {
namespace {

Frame unbent(const Hit& hit) { return Frame::from_tangent(hit.ns, hit.dpdu); }

Frame bent(const Hit& hit, vec3 n, const vec3& tangent) {
  if (!(length_squared(n) > 0.f) || !is_finite(n)) return unbent(hit);
  n = glm::normalize(n);
  if (glm::dot(n, hit.ng) < 0.f) n = -n;
  return Frame::from_tangent(n, tangent);
}

// The tangent plane of the surface moved along the shading normal by the height, differentiated by
// finite differences one footprint wide.
class HeightField final : public ShadingNormals {
 public:
  explicit HeightField(std::shared_ptr<const Texture<float>> height) : height_(std::move(height)) {}

  Frame frame(const Hit& hit) const override {
    const float lu = glm::length(hit.dpdu), lv = glm::length(hit.dpdv);
    const float du = lu > 0.f ? std::fmax(0.5f * hit.footprint / lu, 5e-4f) : 5e-4f;
    const float dv = lv > 0.f ? std::fmax(0.5f * hit.footprint / lv, 5e-4f) : 5e-4f;
    Hit moved = hit;
    const float h = height_->evaluate(hit);
    moved.position = hit.position + du * hit.dpdu;
    moved.uv = hit.uv + vec2(du, 0.f);
    const float hu = height_->evaluate(moved);
    moved.position = hit.position + dv * hit.dpdv;
    moved.uv = hit.uv + vec2(0.f, dv);
    const float hv = height_->evaluate(moved);
    const vec3 dpdu = hit.dpdu + (hu - h) / du * hit.ns + h * hit.dndu;
    const vec3 dpdv = hit.dpdv + (hv - h) / dv * hit.ns + h * hit.dndv;
    return bent(hit, glm::cross(dpdu, dpdv), dpdu);
  }

 private:
  std::shared_ptr<const Texture<float>> height_;
};

class NormalMap final : public ShadingNormals {
 public:
  explicit NormalMap(const ImageFile& file) : image_(file, Encoding::linear(), false) {}

  Frame frame(const Hit& hit) const override {
    const Rgb stored = image_.bilinear({hit.uv.x, 1.f - hit.uv.y}, TextureWrap::repeat);
    return bent(hit, unbent(hit).to_world(2.f * stored - 1.f), hit.dpdu);
  }

 private:
  Mipmap<Rgb> image_;
};

class NormalTexture final : public ShadingNormals {
 public:
  NormalTexture(std::shared_ptr<const Texture<Rgb>> normals, float scale)
      : normals_(std::move(normals)), scale_(scale) {}

  Frame frame(const Hit& hit) const override {
    vec3 n = 2.f * normals_->evaluate(hit) - 1.f;
    const Frame flat = unbent(hit);
    n.x *= scale_;
    n.y *= glm::dot(flat.t, hit.dpdv) < 0.f ? -scale_ : scale_;
    return bent(hit, flat.to_world(n), hit.dpdu);
  }

 private:
  std::shared_ptr<const Texture<Rgb>> normals_;
  float scale_;
};

}  // namespace

std::shared_ptr<const ShadingNormals> bend_by_height(std::shared_ptr<const Texture<float>> height) {
  return std::make_shared<HeightField>(std::move(height));
}

std::shared_ptr<const ShadingNormals> bend_by_map(const std::string& file) {
  const ImageFile image = read_image_file(file);
  if (image.channels < 3) throw Error("'" + file + "' has less than three channels");
  return std::make_shared<NormalMap>(image);
}

std::shared_ptr<const ShadingNormals> bend_by_texture(std::shared_ptr<const Texture<Rgb>> normals,
                                                      float scale) {
  return std::make_shared<NormalTexture>(std::move(normals), scale);
}

}  // namespace pssmlt
