#include "core/scene/scene_state.h"

#include <algorithm>
#include <utility>

#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

constexpr uint32_t pending_bit = 0x80000000u;

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

template <typename Map>
std::vector<std::string> names(const Map& map) {
  std::vector<std::string> result;
  for (const auto& entry : map) result.push_back(entry.first);
  return result;
}

}  // namespace

SceneState::SceneState(SceneDescription& scene, Fail fail, std::vector<std::string>* log)
    : scene_(scene), fail_(std::move(fail)), log_(log) {
  now_.color_space = std::make_shared<const std::string>("srgb");
  scene_.materials.emplace_back();  // the default material: whoever builds the scene knows it
}

void SceneState::fail(const Location& where, const std::string& message) const {
  fail_(where, message);
  throw Error(where, message);  // not reached: fail_ throws
}

void SceneState::note(const Location& where, const std::string& message) {
  if (log_ != nullptr) log_->push_back(to_string(where) + ": " + message);
}

void SceneState::check_new(const std::map<std::string, Location, std::less<>>& known,
                           const char* kind, const std::string& name, const Location& where) const {
  const auto found = known.find(name);
  if (found != known.end())
    fail(where, std::string(kind) + " " + in_quotes(name) + " is already defined at " +
                    to_string(found->second));
}

Directive SceneState::placed(std::string type, ParameterSet parameters,
                             const Location& where) const {
  return {std::move(type), std::move(parameters), where, placement(where)};
}

// What the directive itself gives goes before what Attribute gave.
ParameterSet SceneState::with_attributes(ParameterSet parameters, Target target) const {
  if (now_.attributes[target] == nullptr) return parameters;
  const auto own = static_cast<ptrdiff_t>(parameters.size());
  for (const Parameter& p : *now_.attributes[target]) {
    const auto end = parameters.begin() + own;
    if (std::ranges::find(parameters.begin(), end, p.name, &Parameter::name) == end)
      parameters.push_back(p);
  }
  return parameters;
}

void SceneState::accelerator(std::string type, ParameterSet parameters, const Location& where) {
  scene_.accelerator = {std::move(type), std::move(parameters), where, {}};
}

void SceneState::area_light(std::string type, ParameterSet parameters, const Location& where) {
  now_.area_light = -1;
  if (type.empty()) return;  // pbrt: no emission from here on
  scene_.area_lights.push_back(
      {std::move(type), with_attributes(std::move(parameters), LightTarget), where, {}});
  now_.area_light = static_cast<int>(scene_.area_lights.size()) - 1;
}

void SceneState::attribute(std::string target, ParameterSet parameters, const Location& where) {
  const std::vector<std::string> targets = {"shape", "light", "material", "medium", "texture"};
  const auto found = std::ranges::find(targets, target);
  if (found == targets.end())
    fail(where, "unknown target " + in_quotes(target) +
                    " of Attribute; must be \"shape\", \"light\", \"material\", \"medium\" or "
                    "\"texture\"" +
                    suggestion(target, targets));
  auto& attributes = now_.attributes[static_cast<size_t>(found - targets.begin())];
  ParameterSet merged = attributes != nullptr ? *attributes : ParameterSet();
  for (Parameter& p : parameters) {
    p.was_read = true;  // a default for many directives need not suit every one of them
    const auto old = std::ranges::find(merged, p.name, &Parameter::name);
    if (old != merged.end())
      *old = std::move(p);
    else
      merged.push_back(std::move(p));
  }
  attributes = std::make_shared<const ParameterSet>(std::move(merged));
}

void SceneState::camera(std::string type, ParameterSet parameters, const Location& where) {
  CameraDescription camera{placed(std::move(type), std::move(parameters), where), now_.start_time,
                           now_.end_time, now_.outside_medium};
  TransformPair inverse{camera.transform.start.inverse(), nullptr};
  if (camera.transform.animated())
    inverse.end = std::make_shared<const Transform>(camera.transform.end->inverse());
  if (keep_steps_)
    inverse.steps = std::make_shared<TransformStep>("CoordSysTransform \"camera\"",
                                                    std::array{true, true}, nullptr);
  scene_.coordinate_systems["camera"] = std::move(inverse);
  scene_.camera = std::move(camera);
}

void SceneState::film(std::string type, ParameterSet parameters, const Location& where) {
  scene_.film = {std::move(type), std::move(parameters), where, {}};
  scene_.color_space = *now_.color_space;
}

void SceneState::filter(std::string type, ParameterSet parameters, const Location& where) {
  scene_.filter = {std::move(type), std::move(parameters), where, {}};
}

void SceneState::integrator(std::string type, ParameterSet parameters, const Location& where) {
  Directive& target = in_layer_ ? scene_.layers.back().integrator : integrator_;
  target = {std::move(type), std::move(parameters), where, {}};
}

void SceneState::sampler(std::string type, ParameterSet parameters, const Location& where) {
  Directive& target = in_layer_ ? scene_.layers.back().sampler : sampler_;
  target = {std::move(type), std::move(parameters), where, {}};
}

void SceneState::layer_begin(std::string name, ParameterSet parameters, const Location& where) {
  if (name.empty()) fail(where, "a layer needs a name");
  check_new(layers_, "layer", name, where);
  layers_[name] = where;
  scene_.layers.push_back({std::move(name), std::move(parameters), {}, {}, where});
  in_layer_ = true;
}

void SceneState::layer_end(const Location& where) {
  if (!in_layer_) fail(where, "LayerEnd without LayerBegin");
  in_layer_ = false;
}

void SceneState::light(std::string type, ParameterSet parameters, const Location& where) {
  if (in_object_)
    note(where, "a LightSource between ObjectBegin and ObjectEnd is not instanced: it shines once");
  scene_.lights.push_back(
      {placed(std::move(type), with_attributes(std::move(parameters), LightTarget), where),
       now_.outside_medium});
}

void SceneState::material(std::string type, ParameterSet parameters, const Location& where) {
  scene_.materials.push_back(
      {{std::move(type), with_attributes(std::move(parameters), MaterialTarget), where, {}}, ""});
  now_.material = static_cast<uint32_t>(scene_.materials.size()) - 1;
}

std::string SceneState::take_type(ParameterSet& parameters, const char* kind,
                                  const std::string& name, const Location& where) const {
  const auto found = std::ranges::find(parameters, "type", &Parameter::name);
  if (found == parameters.end())
    fail(where, std::string(kind) + " " + in_quotes(name) +
                    " has no type: the parameter \"string type\" is missing");
  if (found->type != ParameterType::String || found->strings.size() != 1)
    fail(found->where, std::string("parameter \"type\" of ") + kind + " " + in_quotes(name) +
                           " must be one \"string\"");
  std::string type = found->strings[0];
  parameters.erase(found);
  return type;
}

void SceneState::named_material(std::string name, ParameterSet parameters, const Location& where) {
  const auto known = materials_.find(name);
  if (known != materials_.end()) {
    const std::string message = "named material " + in_quotes(name) + " is already defined at " +
                                to_string(scene_.materials[known->second].where);
    if (again_ == nullptr) fail(where, message);
    again_->push_back({message, where, false});
  }
  parameters = with_attributes(std::move(parameters), MaterialTarget);
  std::string type = take_type(parameters, "material", name, where);
  const auto index = static_cast<uint32_t>(scene_.materials.size());
  if (known != materials_.end()) {
    known->second = index;
    name += " (" + std::to_string(index) + ")";
  } else {
    materials_[name] = index;
  }
  scene_.materials.push_back(
      {{std::move(type), std::move(parameters), where, {}}, std::move(name)});
}

void SceneState::named_medium(std::string name, ParameterSet parameters, const Location& where) {
  if (name.empty()) fail(where, "a medium needs a name: \"\" stands for vacuum");
  check_new(media_, "named medium", name, where);
  parameters = with_attributes(std::move(parameters), MediumTarget);
  std::string type = take_type(parameters, "medium", name, where);
  media_[name] = where;
  scene_.media.push_back({placed(std::move(type), std::move(parameters), where), std::move(name)});
}

void SceneState::shape(std::string type, ParameterSet parameters, const Location& where) {
  ShapeDescription shape{
      placed(std::move(type), with_attributes(std::move(parameters), ShapeTarget), where),
      now_.reverse_orientation,
      now_.material,
      now_.area_light,
      now_.inside_medium,
      now_.outside_medium};
  auto& shapes = in_object_ ? scene_.objects.back().shapes : scene_.shapes;
  shapes.push_back(std::move(shape));
}

void SceneState::texture(std::string name, const std::string& value, std::string type,
                         ParameterSet parameters, const Location& where) {
  if (value != "float" && value != "spectrum")
    fail(where, "texture " + in_quotes(name) + " has the unknown type " + in_quotes(value) +
                    "; must be \"float\" or \"spectrum\"");
  const bool is_float = value == "float";
  auto& known = is_float ? float_textures_ : spectrum_textures_;
  name = texture_name(name);
  if (again_ != nullptr && known.contains(name)) name = redeclare_texture(name, is_float, where);
  check_new(known, is_float ? "float texture" : "spectrum texture", name, where);
  known[name] = where;
  scene_.textures.push_back(
      {placed(std::move(type), with_attributes(std::move(parameters), TextureTarget), where),
       std::move(name), is_float ? TextureValue::Float : TextureValue::Spectrum});
}

const std::string& SceneState::texture_name(const std::string& name) const {
  const auto found = texture_names_.find(name);
  return found == texture_names_.end() ? name : found->second;
}

// A new name for the texture that is declared again as `name`. Parameters do not say which form of
// texture they mean, so that one of the other form gets the new name as well.
std::string SceneState::redeclare_texture(const std::string& name, bool is_float,
                                          const Location& where) {
  again_->push_back({"texture " + in_quotes(name) + " is already defined at " +
                         to_string((is_float ? float_textures_ : spectrum_textures_)[name]),
                     where, false});
  std::string plain = name;  // as the scene calls it
  for (const auto& [called, declared] : texture_names_)
    if (declared == name) plain = called;
  const std::string renamed = plain + " (" + std::to_string(scene_.textures.size()) + ")";
  texture_names_[plain] = renamed;
  auto& others = is_float ? spectrum_textures_ : float_textures_;
  if (!others.contains(name)) return renamed;
  others[renamed] = others[name];
  const TextureValue other = is_float ? TextureValue::Spectrum : TextureValue::Float;
  const auto copied = std::ranges::find_if(scene_.textures, [&](const TextureDescription& t) {
    return t.name == name && t.value == other;
  });
  TextureDescription copy = *copied;
  copy.name = renamed;
  scene_.textures.push_back(std::move(copy));
  return renamed;
}

void SceneState::option(Parameter option) {
  option.color_space = now_.color_space;
  std::erase_if(scene_.options, [&](const Parameter& p) { return p.name == option.name; });
  scene_.options.push_back(std::move(option));
}

void SceneState::set_color_space(const std::string& name, const Location& where) {
  static const std::vector<std::string> known = {"aces2065-1", "dci-p3", "rec2020", "srgb"};
  std::string lower = name;
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (std::ranges::find(known, lower) == known.end())
    fail(where, "unknown colour space " + in_quotes(name) +
                    "; must be \"aces2065-1\", \"dci-p3\", \"rec2020\" or \"srgb\"" +
                    suggestion(lower, known));
  now_.color_space = std::make_shared<const std::string>(lower);
}

void SceneState::use_material(const std::string& name, const Location& where) {
  if (const auto known = materials_.find(name); known != materials_.end()) {
    now_.material = known->second;
    return;
  }
  const auto [entry, added] =
      pending_index_.try_emplace(name, static_cast<uint32_t>(pending_materials_.size()));
  if (added) pending_materials_.push_back({name, where});
  now_.material = pending_bit | entry->second;
}

void SceneState::remember_medium(const std::string& name, const Location& where) {
  if (!name.empty()) media_used_.try_emplace(name, where);
}

void SceneState::medium_interface(std::string inside, std::string outside, const Location& where) {
  remember_medium(inside, where);
  remember_medium(outside, where);
  now_.inside_medium = std::move(inside);
  now_.outside_medium = std::move(outside);
}

void SceneState::world_begin(const Location& where) {
  if (in_layer_)
    fail(where, "LayerEnd is missing: layer " + in_quotes(scene_.layers.back().name) +
                    " is open since " + to_string(scene_.layers.back().where));
  if (pushed_.size() > import_base_) fail_unclosed(pushed_.back());
  if (scene_.layers.empty()) scene_.layers.emplace_back();
  for (LayerDescription& layer : scene_.layers) {
    if (!layer.sampler.given()) layer.sampler = sampler_;
    if (!layer.integrator.given()) layer.integrator = integrator_;
  }
  block_ = Block::World;
  now_.ctm = {};
  now_.singular = {};
  now_.active = {true, true};
  now_.steps = nullptr;
  scene_.coordinate_systems["world"] = {};
}

void SceneState::check_media() const {
  for (const auto& [name, where] : media_used_)
    if (!media_.contains(name))
      fail(where,
           "medium " + in_quotes(name) + " is not defined" + suggestion(name, names(media_)));
}

void SceneState::resolve_materials() {
  std::vector<uint32_t> index;
  for (const PendingName& pending : pending_materials_) {
    const auto found = materials_.find(pending.name);
    if (found == materials_.end())
      fail(pending.where, "named material " + in_quotes(pending.name) + " is not defined" +
                              suggestion(pending.name, names(materials_)));
    index.push_back(found->second);
  }
  const auto resolve = [&index](std::vector<ShapeDescription>& shapes) {
    for (ShapeDescription& s : shapes)
      if ((s.material & pending_bit) != 0) s.material = index[s.material & ~pending_bit];
  };
  resolve(scene_.shapes);
  for (ObjectDescription& object : scene_.objects) resolve(object.shapes);
}

void SceneState::resolve_instances() {
  std::vector<size_t> next(scene_.objects.size() + 1, 0);  // of each place's instances, world first
  for (const PendingInstance& pending : instance_names_) {
    const auto found = objects_.find(pending.name);
    if (found == objects_.end())
      fail(pending.where, "object " + in_quotes(pending.name) + " is not defined" +
                              suggestion(pending.name, names(objects_)));
    const auto place = static_cast<size_t>(pending.inside + 1);
    auto& instances = place == 0 ? scene_.instances : scene_.objects[place - 1].instances;
    instances[next[place]++].object = found->second;
  }
  check_nesting();
}

void SceneState::finish(const Location& end) {
  if (!pushed_.empty()) fail_unclosed(pushed_.back());
  if (block_ == Block::Options) fail(end, "the scene ends before WorldBegin");
  check_media();
  resolve_materials();
  resolve_instances();
}

}  // namespace pssmlt
