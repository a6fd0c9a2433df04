// Makes shapes, lights, cameras and filters for tests from a line of scene text.
#pragma once

#include <memory>
#include <string>

#include "core/base/random.h"
#include "core/camera.h"
#include "core/filter.h"
#include "core/light.h"
#include "core/scene/parser.h"
#include "core/shape.h"
#include "tests/support/make_plugin.h"

namespace pssmlt::test {

template <typename Kind>
std::shared_ptr<Kind> make_from(const std::string& kind, const Directive& d,
                                const PluginArguments& arguments = {}, bool reverse = false,
                                bool to_world = true) {
  Resolver resolver;
  Parameters parameters(d.parameters, d.where, kind + " \"" + d.type + "\"", &resolver);
  parameters.set_transform(to_world ? d.transform.start : d.transform.start.inverse());
  parameters.set_reverse_orientation(reverse);
  return make_plugin<Kind>(Registry::instance().find(kind, d.type, d.where), parameters, arguments);
}

// `text`: directives up to and with one Shape.
inline std::shared_ptr<Shape> make_shape(const std::string& text) {
  const SceneDescription scene = parse_string("WorldBegin\n" + text, "test");
  const ShapeDescription& shape = scene.shapes.at(0);
  return make_from<Shape>("shape", shape, {}, shape.reverse_orientation);
}

// `text`: one LightSource, or one AreaLightSource and its Shape.
inline std::shared_ptr<Light> make_light(const std::string& text,
                                         std::shared_ptr<const Texture<float>> alpha = nullptr) {
  const SceneDescription scene = parse_string("WorldBegin\n" + text, "test");
  if (!scene.lights.empty()) return make_from<Light>("light", scene.lights[0]);
  PluginArguments arguments;
  const ShapeDescription& shape = scene.shapes.at(0);
  arguments.shape = make_from<Shape>("shape", shape, {}, shape.reverse_orientation);
  arguments.alpha = std::move(alpha);
  return make_from<Light>("arealight", scene.area_lights.at(0), arguments);
}

// `text`: directives up to and with one Camera.
inline std::shared_ptr<Camera> make_camera(const std::string& text, const RasterFrame& frame) {
  const SceneDescription scene = parse_string(text + "\nWorldBegin\n", "test");
  PluginArguments arguments;
  arguments.frame = &frame;
  return make_from<Camera>("camera", scene.camera, arguments, false, false);
}

inline std::shared_ptr<Filter> make_filter(const std::string& text) {
  const SceneDescription scene = parse_string("PixelFilter " + text + "\nWorldBegin\n", "test");
  return make_from<Filter>("filter", scene.filter);
}

// A point of the unit square, from two draws.
inline vec2 draw2(RandomStream& random) {
  const float x = random.next();
  const float y = random.next();
  return {x, y};
}

}  // namespace pssmlt::test
