#include "core/render/replay.h"

#include <fmt/format.h>

#include "core/render/session.h"
#include "core/sampling/replay.h"
#include "core/scene/path_log.h"

namespace pssmlt {
namespace {

// Independent numbers of one sample of one pixel.
class PixelSource final : public NumberSource {
 public:
  PixelSource(uint64_t seed, int pixel, int index)
      : seed_(seed), pixel_(static_cast<uint32_t>(pixel)), index_(static_cast<uint32_t>(index)) {}
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    const uint32_t use =
        static_cast<uint32_t>(RandomUse::auxiliary) | (static_cast<uint32_t>(stream) + 1) << 16;
    block = philox(seed_, {index, pixel_, index_, use});
  }

 private:
  uint64_t seed_;
  uint32_t pixel_, index_;
};

// Shows rays while it lives.
class Listening {
 public:
  explicit Listening(const LineListener& line) {
    set_path_log([line](const std::string& text) { line("    " + text); });
  }
  ~Listening() { set_path_log({}); }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;
};

std::string describe(const Splat& s, const dvec2& camera_raster) {
  const dvec2 at = s.from_camera ? camera_raster : s.raster;
  return fmt::format(
      "    {} splat at ({:.17g}, {:.17g}): ({:.9g}, {:.9g}, {:.9g}), {} bounces, s={} t={}",
      s.from_camera ? "camera" : "light", at.x, at.y, s.value.x, s.value.y, s.value.z,
      s.tag.bounces, s.tag.s, s.tag.t);
}

// The point has been evaluated: tells what came of it.
void tell(LayerTools& tools, const RejectionLog& log, const LineListener& line) {
  PrimarySample& u = tools.sample.sample();
  const dvec2 raster = u.raster_known() ? u.raster() : dvec2(-1.0);
  for (const Splat& s : tools.splats.all()) line(describe(s, raster));
  if (log.total() != 0) {
    line("    dropped: " + std::string(to_string(log.examples().back().cause)));
  } else if (tools.splats.empty()) {
    line("    no splats");
  }
  line("    " + numbers_to_text(u));
}

void evaluate_and_tell(LayerTools& tools, const RejectionLog& log, const LineListener& line) {
  {
    const Listening listening(line);
    (void)tools.evaluator.evaluate(tools.sample.sample(), tools.splats, tools.workspace);
  }
  tell(tools, log, line);
}

std::string title(const Layer& layer) {
  return layer.integrator_name + (layer.name.empty() ? "" : " (layer \"" + layer.name + "\")");
}

void start(const BuiltScene& scene, const Layer& layer, uint64_t seed, LayerTools& tools) {
  const SamplerContext context{*scene.scene, *layer.integrator, *scene.raster_map, seed,
                               [&](int count, const std::function<void(int, Worker&)>& body) {
                                 for (int unit = 0; unit < count; ++unit) body(unit, tools.worker);
                               }};
  layer.sampler->start(context);
}

void replay_named(const BuiltScene& scene, const std::string& key, uint64_t seed,
                  const LineListener& line) {
  for (size_t l = 0; l < scene.layers.size(); ++l) {
    const Layer& layer = scene.layers[l];
    if (!key.starts_with(layer.sampler_name + ':')) continue;
    RejectionLog log;
    LayerTools tools(*layer.integrator, *scene.raster_map, log, true, scene.radiance_scale);
    start(scene, layer, layer_seed(seed, l), tools);
    std::vector<std::string> rays;
    {
      const Listening listening([&rays](const std::string& text) { rays.push_back(text); });
      if (!layer.sampler->replay(key, tools.worker)) continue;
    }
    line("sample " + key + ", " + title(layer) + ":");
    for (const std::string& ray : rays) line(ray);
    tell(tools, log, line);
    return;
  }
  throw Error("\"" + key + "\" names no sample of this scene's samplers under seed " +
              std::to_string(seed));
}

}  // namespace

void trace_pixel(const BuiltScene& scene, const ivec2& pixel, int samples, uint64_t seed,
                 const LineListener& line) {
  const RasterFrame& frame = scene.raster_map->frame();
  const ivec2 at = pixel - frame.crop_min;
  const ivec2 size = frame.crop_size();
  if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) {
    throw Error(fmt::format("pixel {},{} is outside the rendered window {},{} to {},{}", pixel.x,
                            pixel.y, frame.crop_min.x, frame.crop_min.y, frame.crop_max.x,
                            frame.crop_max.y));
  }
  for (const Layer& layer : scene.layers) {
    for (int s = 0; s < samples; ++s) {
      RejectionLog log;
      LayerTools tools(*layer.integrator, *scene.raster_map, log, true, scene.radiance_scale);
      PixelSource source(seed, at.y * size.x + at.x, s);
      tools.sample.begin(source);
      tools.sample.set_pixel(at.y * size.x + at.x);
      line(fmt::format("pixel {},{}, sample {}, {}:", pixel.x, pixel.y, s, title(layer)));
      evaluate_and_tell(tools, log, line);
    }
  }
}

void replay_sample(const BuiltScene& scene, const std::string& key, uint64_t seed,
                   const LineListener& line) {
  SampleName name;
  if (parse_sample_name(key, name)) return replay_named(scene, key, seed, line);
  for (const Layer& layer : scene.layers) {
    RejectionLog log;
    LayerTools tools(*layer.integrator, *scene.raster_map, log, true, scene.radiance_scale);
    if (!numbers_from_text(key, tools.sample)) {
      throw Error("\"" + key + "\" is not a replay key: \"sampler:seed:pixel:index\" or \"u:...\"");
    }
    line("sample given by its numbers, " + title(layer) + ":");
    evaluate_and_tell(tools, log, line);
  }
}

}  // namespace pssmlt
