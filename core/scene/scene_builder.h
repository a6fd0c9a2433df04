// What build_scene() does, in steps.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/accel.h"
#include "core/scene/builder.h"
#include "core/scene/builder_media.h"
#include "core/scene/builder_options.h"
#include "core/scene/builder_resolver.h"

namespace pssmlt {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Throws Error if the directive is animated; `what`: plural, for the message.
inline void refuse_animation(const TransformPair& transform, const Location& where,
                             const std::string& what) {
  if (transform.animated()) throw Error(where, what + " cannot move");
}

// Fills a Scene step by step. World space is moved so that the camera's centre is the origin of
// render space: float's resolution is best where the picture looks. An option may ask for others.
class SceneBuilder {
 public:
  SceneBuilder(const SceneDescription& description, const BuildOptions& options)
      : description_(description),
        options_(options),
        scene_options_(read_scene_options(description, built_.log)),
        to_render_(find_to_render()),
        resolver_(description, to_render_, options.defaults.material, built_.log),
        scene_(std::make_unique<Scene>()),
        media_(resolver_, scene_->features_) {}

  BuiltScene build();

 private:
  friend class ObjectsBuilder;
  Transform find_to_render() const;
  // From render space, for normals: to the world, or to the camera when its shutter opens
  // (BuiltScene::normal_axes).
  glm::dmat3 find_normal_axes(bool of_camera) const;
  void read_options();
  void build_raster();
  void build_camera();
  void build_lights();
  void build_shapes();
  void check_place(const Shape& shape, const Transform& placed, const Location& where);
  void note_coarse_grid(const Bounds& box, const Transform& placed, const Location& where);
  void tell_coarse_grid();
  void tell_touching_interfaces();
  struct PlacedInstance {
    Accel::Instance instance;
    Location where;
  };
  PlacedInstance place(uint32_t object, const TransformPair& transform, const Location& where);
  void build_moving_shape(const ShapeDescription& shape,
                          std::vector<std::vector<const Primitive*>>& objects,
                          std::vector<PlacedInstance>& instances);
  void build_accel(const std::vector<const Primitive*>& top,
                   const std::vector<std::vector<const Primitive*>>& objects,
                   std::vector<PlacedInstance> placed);
  void check_reach(const std::vector<Location>& places);
  void move_camera();
  // Null if there is nothing to be seen or to bound.
  const Primitive* build_placed(const ShapeDescription& shape, const Transform& space);
  const Primitive* keep(std::unique_ptr<Primitive> primitive);
  // placed: the shape's own transformation and all that follows it.
  std::unique_ptr<Primitive> build_primitive(const ShapeDescription& shape,
                                             const Transform& placed);
  void attach_area_light(const ShapeDescription& shape, const Transform& space,
                         Primitive& primitive);
  // around: the media on the light's sides.
  void add_light(std::shared_ptr<Light> light, const MediumInterface& around);
  void count(const Primitive& primitive);
  void finish_lights();
  void finish_features();

  const SceneDescription& description_;
  const BuildOptions& options_;
  BuiltScene built_;
  SceneOptions scene_options_;
  Transform to_render_;
  BuildResolver resolver_;
  std::unique_ptr<Scene> scene_;
  MediaBuilder media_;
  // Shapes whose coordinates are written on a float grid that is coarse for them.
  size_t coarse_shapes_ = 0;
  Location first_coarse_;
  double coarsest_ = 0.0;  // rounding of coordinates over the shape's size
};

}  // namespace pssmlt
