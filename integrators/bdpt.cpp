// Bidirectional path tracing (Veach 1997, chapter 10; Lafortune and Willems 1993): a subpath from
// the camera and one from a light, all their vertices joined, every strategy (s light vertices,
// t camera vertices; s >= 0, t >= 1) weighted by multiple importance sampling. The weights are
// recursive (Georgiev et al. 2012, Implementing Vertex Connection and Merging), O(1) a strategy.
// Good for light that both ends find half-way; blind only to specular-diffuse-specular paths from
// lights that can't be hit.

#include "core/integrator.h"
#include "core/path/dispersion.h"
#include "core/path/flight.h"
#include "core/path/sensor_draw.h"
#include "core/path/strategies.h"
#include "core/path/subpath_cache.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr std::string_view heuristics[] = {"balance", "power"};

// Vertices past this index are joined with one vertex of the other side, drawn at random, so that
// the work grows linearly with the depth.
constexpr int all_pairs = 32;

struct Scratch {
  SubpathCache camera, light;
};

// One technique: s vertices on the light subpath, t on the camera subpath.
struct Strategy {
  int s = 0, t = 0;
  int bounces() const { return s + t - 2; }
  PathTag tag() const {
    return {static_cast<uint32_t>(bounces()), static_cast<uint8_t>(std::min(s, 255)),
            static_cast<uint8_t>(std::min(t, 255))};
  }
};

double as_double(float x) { return static_cast<double>(x); }

// Density with which the endpoint's emission samples the vertex, over that of drawing the endpoint
// from there (`drawn`); the length of the edge cancels. arrival: Surface::arrival() of the vertex.
double emitted_over_drawn(const Toward& t, float arrival, float drawn) {
  return as_double(t.pdf_position) * as_double(t.pdf_direction) * as_double(arrival) /
         (as_double(t.cosine) * as_double(drawn));
}

class Bdpt final : public Integrator {
 public:
  static constexpr const char* summary =
      "bidirectional path tracing, all strategies with multiple importance sampling (Veach 1997)";

  explicit Bdpt(Parameters& p)
      : limits_(p),
        // Balance has the smaller error at equal time on the scenes of this project, by 1 to 10 %.
        mis_(p.choice("heuristic", "balance", heuristics,
                      "weights of the strategies (Veach 1997, "
                      "section 9.2)") == "power"
                 ? Mis::Heuristic::power
                 : Mis::Heuristic::balance),
        near_(read_light_pick(p)),
        far_(near_ == LightPick::bvh ? LightPick::power : near_),
        unweighted_(p.flag("unweighted", false,
                           "every strategy counts in full, to look at "
                           "strategies one by one; the picture is not their sum")),
        only_s_(p.integer("s", -1, "vertices",
                          "only strategies with this many light vertices; "
                          "-1: all")),
        only_t_(p.integer("t", -1, "vertices",
                          "only strategies with this many camera vertices; "
                          "-1: all")) {
    const bool strategies = p.flag("visualizestrategies", false,
                                   "read, not applied: ask the renderer for images by strategy");
    const bool weights = p.flag("visualizeweights", false, "as above");
    if (p.describing()) return;
    if (strategies || weights) {
      p.note(
          "images by strategy are not applied here: --per-strategy writes them (with \"bool "
          "unweighted\" true the unweighted ones)");
    }
    if (only_s_ < -1) p.fail("s", "s must be -1 or a number of vertices");
    if (only_t_ < -1 || only_t_ == 0) p.fail("t", "t must be -1 or a number of vertices from 1 on");
  }

  void prepare(const Scene& scene) override {
    scene_ = &scene;
    tracer_ = std::make_unique<SubpathTracer>(scene, limits_, mis_, far_);
    // Without a surface that can be joined, light subpaths only serve to show the lamps themselves,
    // which the camera subpath does better.
    light_side_ = scene.features().connectible && !scene.lights().empty();
    sensor_ = scene.camera().bare() && !scene.lights().empty();
    lamps_to_lens_ = !sensor_ && light_side_ && scene.features().area_lights;
  }
  std::string sees() const override {
    const std::string common =
        strategy::any_of({strategy::hit_light, strategy::next_event, strategy::join, strategy::lens,
                          strategy::light_to_lens});
    return sensor_ ? strategy::any_of({common.c_str(), strategy::sensor_draw}) : common;
  }
  bool splats_light() const override { return true; }
  const PathLimits& limits() const override { return limits_; }
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;

 private:
  LightPick pick_for(const PathVertex& v) const { return v.mirrored ? near_ : far_; }
  bool wants(Strategy st) const {
    return (only_s_ < 0 || only_s_ == st.s) && (only_t_ < 0 || only_t_ == st.t) &&
           limits_.in_range(st.bounces());
  }
  float weight(double light_side, double camera_side) const {
    return unweighted_ ? 1.f : static_cast<float>(Mis::weight(light_side, camera_side));
  }
  // Of the path's wavelength, if it has one.
  static Rgb colour(bool dispersed, PrimarySample& u) {
    return dispersed ? path_wavelength(u).colour : Rgb(1.f);
  }
  void hit_lights(const Subpath& camera, PrimarySample& u, Splats& out) const;
  void meet_medium(const Subpath& camera, int k, PrimarySample& u, Splats& out) const;
  void hit(const Subpath& camera, int bounces, const Light& light, const EndpointPoint& at,
           Rgb value, PrimarySample& u, Splats& out) const;
  void draw_lights(const Subpath& camera, PrimarySample& u, Splats& out) const;
  void draw_light_from(const PathVertex& x, Strategy st, PrimarySample& u, Splats& out) const;
  void draw_light_for_sensor(const Subpath& camera, PrimarySample& u, Splats& out) const;
  void lens_from_light(const Subpath& light, PrimarySample& u, Splats& out) const;
  void lens_from(const Subpath& light, int k, PrimarySample& u, Splats& out) const;
  MisPartial partial_at_lens(const Subpath& light, int k) const;
  void join_all(const Subpath& camera, const Subpath& light, PrimarySample& u, Splats& out) const;
  void join(const PathVertex& x, const PathVertex& y, Strategy st, float factor, PrimarySample& u,
            Splats& out) const;

  PathLimits limits_;
  Mis mis_;
  // How lights are drawn for vertices that the camera sees, if by way of mirrors, and for those
  // behind them. There the hierarchy costs as much and gains less: light subpaths reach them.
  LightPick near_, far_;
  bool unweighted_;
  int only_s_, only_t_;
  const Scene* scene_ = nullptr;
  std::unique_ptr<const SubpathTracer> tracer_;
  bool light_side_ = false;  // light subpaths are made
  // How the strategy s = t = 1 is made: a light's point joined with the lens, or a light drawn for
  // the point of a camera that is a bare surface.
  bool lamps_to_lens_ = false, sensor_ = false;
};

void Bdpt::sample(PrimarySample& u, Splats& out, Workspace& workspace) const {
  Scratch& scratch = workspace.scratch<Scratch>();
  const int room = std::min(limits_.max_bounces + 1, 200);
  scratch.camera.reserve(room);
  scratch.light.reserve(room);
  bool fresh = false;
  Subpath& camera = scratch.camera.find(u.version(Stream::camera), fresh);
  u.raster();  // camera splats are credited there, whether or not the subpath is reused
  if (fresh) tracer_->from_camera(u, camera);
  hit_lights(camera, u, out);
  if (sensor_) draw_light_for_sensor(camera, u, out);
  draw_lights(camera, u, out);
  if (!light_side_) return;
  Subpath& light = scratch.light.find(u.version(Stream::light), fresh);
  if (fresh) tracer_->from_light(u, light);
  if (!light.started) return;
  lens_from_light(light, u, out);
  for (int k = 1; k <= light.size(); ++k) lens_from(light, k, u, out);
  join_all(camera, light, u, out);
}

// s = 0: camera subpaths that met a light.
void Bdpt::hit_lights(const Subpath& camera, PrimarySample& u, Splats& out) const {
  for (int k = 1; k <= camera.size(); ++k) {
    const Surface& s = camera[k].surface;
    if (s.in_medium()) {
      meet_medium(camera, k, u, out);
      continue;
    }
    const Light* const light = s.hit.primitive->light;
    if (!light || s.emerging()) continue;
    hit(camera, k - 1, *light, s.light_point(), scene_->emitted(s.hit, s.wo), u, out);
  }
  const Escape& escape = camera.escape;
  if (escape.bounces < 0) return;
  EndpointPoint at;
  at.normal = -escape.direction;
  for (const Light* light : scene_->lights().infinite()) {
    hit(camera, escape.bounces, *light, at, light->background(escape.direction), u, out);
  }
}

// Light that a medium emits at a camera subpath's vertex; no other strategy makes it.
void Bdpt::meet_medium(const Subpath& camera, int k, PrimarySample& u, Splats& out) const {
  const PathVertex& v = camera[k];
  const Strategy st{0, k + 1};
  const Rgb& emission = v.surface.point().emission;
  if (is_black(emission) || !wants(st)) return;
  if (!limits_.paths.ends(LightLetter::medium, v.state)) return;
  out.camera(colour(camera.dispersed_before(k), u) * v.throughput * emission, st.tag());
}

// The subpath's vertex bounces + 1 lies on the light (or is its escape), which emits `value`.
void Bdpt::hit(const Subpath& camera, int bounces, const Light& light, const EndpointPoint& at,
               Rgb value, PrimarySample& u, Splats& out) const {
  const Strategy st{0, bounces + 2};
  if (!wants(st) || is_black(value)) return;
  const EndpointTraits traits = light.traits();
  const bool infinite = traits.infinite;
  const PathVertex* const v = infinite ? nullptr : &camera[bounces + 1];
  if (!limits_.paths.ends(light_letter(traits), v ? v->state : camera.escape.state)) return;
  const MisPartial& mis = v ? v->mis : camera.escape.mis;
  const vec3 direction = v ? v->surface.wo : -camera.escape.direction;
  const double p = as_double(scene_->lights().probability(&light));
  const EmissionValue e = light.evaluate(at, direction);
  const Rgb& throughput = v ? v->throughput : camera.escape.throughput;
  if (bounces == 0 && sensor_) {
    // Against the same light drawn for the camera's point; what media absorb counts in neither.
    const LightReceiver sensor = sensor_receiver(camera.start);
    const double drawn = as_double(scene_->lights().probability(near_, sensor, &light)) *
                         as_double(light.pdf_toward(sensor.position, at));
    const double ratio = mis_.f(drawn / as_double(camera.start.pdf_direction));
    return out.camera(weight(0.0, ratio) * throughput * value, st.tag());
  }
  double connect = 0.0;
  if (bounces == 0) {
    // Only s = t = 1 could have made this path, with a point drawn as for emission.
    connect = lamps_to_lens_ && v ? p * as_double(e.pdf_position) : 0.0;
  } else if (mis.connect > 0.0) {
    const Surface& last = camera[bounces].surface;
    const vec3& from = last.hit.position;
    const LightPick pick = pick_for(camera[bounces]);
    const LightReceiver receiver = light_receiver(*scene_, pick, last);
    connect = as_double(scene_->lights().probability(pick, receiver, &light)) *
              as_double(light.pdf_toward(from, at));
    if (v) {
      connect *= as_double(std::abs(glm::dot(v->surface.hit.ng, direction))) /
                 as_double(length_squared(at.position - from));
    }
  }
  const double emit = p * as_double(e.pdf_position) * as_double(e.pdf_direction);
  value *= colour(camera.dispersed_before(bounces + 1), u);
  out.camera(weight(0.0, mis_.on_light(mis, connect, emit)) * throughput * value, st.tag());
}

// s = 1: next event estimation.
void Bdpt::draw_lights(const Subpath& camera, PrimarySample& u, Splats& out) const {
  if (scene_->lights().empty()) return;
  for (int k = 1; k <= camera.size(); ++k) {
    if (camera[k].connectible) draw_light_from(camera[k], {1, k + 1}, u, out);
  }
}

void Bdpt::draw_light_from(const PathVertex& x, Strategy st, PrimarySample& u, Splats& out) const {
  if (!wants(st)) return;
  const Surface& surface = x.surface;
  const LightDraw draw(*scene_, pick_for(x), surface, light_numbers(u, st.t - 1));
  if (!draw.succeeded() || !limits_.paths.ends(draw.letter(), x.joined_state)) return;
  const Toward& t = draw.toward();
  const auto scattering = surface.scattering(t.wi, Transport::radiance);
  const Rgb value = x.throughput * scattering.f_cos * t.value / draw.pdf();
  if (is_black(value)) return;
  const Passage way = passage(*scene_, surface.segment(t), surface.medium_toward(t.wi));
  if (!(way.visibility > 0.f)) return;
  const float met = scattering.pdf * mean(way.transmittance);
  const double light_side = draw.hittable() ? mis_.f(as_double(met) / as_double(draw.pdf())) : 0.0;
  const double emit = as_double(draw.emitted_over_drawn()) *
                      emitted_over_drawn(t, surface.arrival(t.wi, way.transmittance), t.pdf_toward);
  const double camera_side =
      light_side_ ? mis_.join(x.mis, emit, as_double(scattering.pdf_reverse)) : 0.0;
  out.camera(weight(light_side, camera_side) * way.light() * colour(x.dispersed, u) * value,
             st.tag());
}

// s = t = 1, for cameras that are bare surfaces.
void Bdpt::draw_light_for_sensor(const Subpath& camera, PrimarySample& u, Splats& out) const {
  const Strategy st{1, 1};
  if (!camera.started || !wants(st)) return;
  const SensorDraw draw(*scene_, near_, camera.start, camera.time, light_numbers(u, 0));
  if (!draw.succeeded()) return;
  if (!limits_.paths.ends(draw.letter(), limits_.paths.from_camera())) return;
  const Passage way = draw.way();
  if (!(way.visibility > 0.f)) return;
  const double met = mis_.f(as_double(draw.met()) / as_double(draw.pdf()));
  out.camera(weight(met, 0.0) * way.light() * draw.value(), st.tag());
}

// s = t = 1: the light itself as the lens sees it.
void Bdpt::lens_from_light(const Subpath& light, PrimarySample& u, Splats& out) const {
  const Strategy st{1, 1};
  const EndpointTraits& traits = light.traits;
  if (!lamps_to_lens_ || !wants(st) || light_letter(traits) != LightLetter::area) return;
  const PathExpression& paths = limits_.paths;
  if (!paths.ends(LightLetter::area, paths.from_camera())) return;
  const EndpointPoint& at = light.start.from;
  const auto lens = scene_->camera_toward(at.position, lens_connection_numbers(u, 0), light.time);
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const EmissionValue e = light.emitted(lens->wi);
  const float drawn = light.probability * light.start.pdf_position * lens->pdf_toward;
  const Rgb value = e.value * lens->value * (e.cosine / drawn);
  if (is_black(value)) return;
  const Ray ray = Scene::segment(at.position, light.start.error, at.normal, lens->at.position,
                                 lens->error, lens->at.normal, light.time);
  const Passage way = passage(*scene_, ray, scene_->light_medium(*light.light, at, lens->wi));
  // The other strategy: a camera ray meets the light.
  const double met = emitted_over_drawn(*lens, e.cosine * mean(way.transmittance), drawn);
  out.light(lens->raster, weight(mis_.f(met), 0.0) * way.light() * value, st.tag());
}

// t = 1: a light subpath's vertex as the lens sees it.
void Bdpt::lens_from(const Subpath& light, int k, PrimarySample& u, Splats& out) const {
  const PathVertex& y = light[k];
  const Strategy st{k + 1, 1};
  if (!y.connectible || !wants(st)) return;
  const PathExpression& paths = limits_.paths;
  if (!paths.joins(y.joined_state, paths.from_camera())) return;
  const Surface& surface = y.surface;
  const auto lens = scene_->camera_toward(surface.hit.position,
                                          lens_connection_numbers(u, st.s - 1), surface.time);
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const auto scattering = surface.scattering(lens->wi, Transport::importance);
  const Rgb value = y.throughput * scattering.f_cos * lens->value / lens->pdf_toward;
  if (is_black(value)) return;
  const Passage way = passage(*scene_, surface.segment(*lens), surface.medium_toward(lens->wi));
  if (!(way.visibility > 0.f)) return;
  const double emit =
      emitted_over_drawn(*lens, surface.arrival(lens->wi, way.transmittance), lens->pdf_toward);
  const double light_side =
      mis_.join(partial_at_lens(light, k), emit, as_double(scattering.pdf_reverse));
  out.light(lens->raster, weight(light_side, 0.0) * way.light() * colour(y.dispersed, u) * value,
            st.tag());
}

// The light's first vertex, seen from the lens, is one for which a camera subpath draws lights by
// near_; everywhere else the vertex beside the light has a joined one between it and the lens.
MisPartial Bdpt::partial_at_lens(const Subpath& light, int k) const {
  MisPartial partial = light[k].mis;
  const LightTable& lights = scene_->lights();
  if (k > 1 || near_ == far_ || !lights.by_place(near_)) return partial;
  const LightReceiver at = light_receiver(*scene_, near_, light[k].surface);
  const double far = as_double(lights.probability(far_, at, light.light));
  partial.connect *= mis_.f(as_double(lights.probability(near_, at, light.light)) / far);
  return partial;
}

// s, t >= 2. Every pair of vertices up to the bound; past it each vertex of the camera subpath is
// joined with one vertex drawn uniformly, which then counts for all it could have been.
void Bdpt::join_all(const Subpath& camera, const Subpath& light, PrimarySample& u,
                    Splats& out) const {
  for (int k = 1; k <= camera.size(); ++k) {
    const PathVertex& x = camera[k];
    if (!x.connectible) continue;
    // Light vertices that may be joined: s + t - 2 = (j + 1) + (k + 1) - 2 bounces.
    const int last = std::min(light.size(), limits_.max_bounces - k);
    const int all = k <= all_pairs ? std::min(last, all_pairs) : 0;
    for (int j = 1; j <= all; ++j) join(x, light[j], {j + 1, k + 1}, 1.f, u, out);
    const int rest = last - all;
    if (rest <= 0) continue;
    const float pick = light_numbers(u, k).pick;
    const int j = all + 1 + std::min(static_cast<int>(pick * static_cast<float>(rest)), rest - 1);
    join(x, light[j], {j + 1, k + 1}, static_cast<float>(rest), u, out);
  }
}

void Bdpt::join(const PathVertex& x, const PathVertex& y, Strategy st, float factor,
                PrimarySample& u, Splats& out) const {
  if (!y.connectible || !wants(st)) return;
  if (!limits_.paths.joins(y.joined_state, x.joined_state)) return;
  const vec3 edge = y.surface.hit.position - x.surface.hit.position;
  const float distance2 = length_squared(edge);
  if (!(distance2 > 0.f)) return;
  const vec3 to_y = edge / std::sqrt(distance2);
  const vec3 to_x = -to_y;
  const auto at_camera = x.surface.scattering(to_y, Transport::radiance);
  if (is_black(at_camera.f_cos)) return;
  const auto at_light = y.surface.scattering(to_x, Transport::importance);
  const Rgb value =
      x.throughput * at_camera.f_cos * at_light.f_cos * y.throughput * (factor / distance2);
  if (is_black(value)) return;
  const Passage way = passage(*scene_, x.surface.segment(y.surface), x.surface.medium_toward(to_y));
  if (!(way.visibility > 0.f)) return;
  const double d2 = as_double(distance2);
  // Densities per area, in media per volume, of each vertex as sampled from the other side.
  const Rgb& passed = way.transmittance;
  const double at_y = as_double(at_camera.pdf) * as_double(y.surface.arrival(to_y, passed)) / d2;
  const double at_x = as_double(at_light.pdf) * as_double(x.surface.arrival(to_x, passed)) / d2;
  const double light_side = mis_.join(y.mis, at_y, as_double(at_light.pdf_reverse));
  const double camera_side = mis_.join(x.mis, at_x, as_double(at_camera.pdf_reverse));
  out.camera(
      weight(light_side, camera_side) * way.light() * colour(x.dispersed || y.dispersed, u) * value,
      st.tag());
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "bdpt", pssmlt::Bdpt, {"mlt", "pssmlt"}, {"sppm", ""})
