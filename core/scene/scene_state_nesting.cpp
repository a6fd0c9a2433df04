// The part of SceneState that is a stack: transformations, attributes, objects, imports.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/scene/scene_state.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

std::string begin_name(SceneState::Nested kind) {
  switch (kind) {
    case SceneState::Nested::Attribute:
      return "AttributeBegin";
    case SceneState::Nested::Transform:
      return "TransformBegin";
    case SceneState::Nested::Object:
      return "ObjectBegin";
  }
  return "";
}

std::string end_name(SceneState::Nested kind) {
  switch (kind) {
    case SceneState::Nested::Attribute:
      return "AttributeEnd";
    case SceneState::Nested::Transform:
      return "TransformEnd";
    case SceneState::Nested::Object:
      return "ObjectEnd";
  }
  return "";
}

bool all_finite(const dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

}  // namespace

void SceneState::fail_unclosed(const Pushed& open) const {
  fail(open.where, begin_name(open.kind) + " without " + end_name(open.kind));
}

void SceneState::push(Nested kind, const Location& where) {
  if (kind == Nested::Transform && !noted_transform_begin_) {
    note(where, "TransformBegin and TransformEnd are deprecated; use AttributeBegin");
    noted_transform_begin_ = true;
  }
  pushed_.push_back({kind, where, now_});
}

void SceneState::pop(Nested kind, const Location& where) {
  if (pushed_.size() <= import_base_) fail(where, end_name(kind) + " without " + begin_name(kind));
  Pushed& top = pushed_.back();
  if (top.kind != kind)
    fail(where,
         end_name(kind) + " closes the " + begin_name(top.kind) + " at " + to_string(top.where));
  if (kind == Nested::Transform) {  // saves the transformations alone
    now_.ctm = top.state.ctm;
    now_.singular = top.state.singular;
    now_.active = top.state.active;
    now_.steps = top.state.steps;
  } else {
    now_ = std::move(top.state);
  }
  pushed_.pop_back();
}

void SceneState::object_begin(const std::string& name, const Location& where) {
  if (in_object_)
    fail(where,
         "ObjectBegin inside the definition of object \"" + scene_.objects.back().name + "\"");
  if (const auto known = objects_.find(name); known != objects_.end())
    fail(where, "object \"" + name + "\" is already defined at " +
                    to_string(scene_.objects[known->second].where));
  push(Nested::Object, where);
  objects_[name] = static_cast<uint32_t>(scene_.objects.size());
  scene_.objects.push_back({name, where, {}, {}});
  in_object_ = true;
}

void SceneState::object_end(const Location& where) {
  pop(Nested::Object, where);
  in_object_ = false;
}

void SceneState::object_instance(const std::string& name, const Location& where) {
  auto& instances = in_object_ ? scene_.objects.back().instances : scene_.instances;
  instances.push_back({0, placement(where), where});
  const int inside = in_object_ ? static_cast<int>(scene_.objects.size()) - 1 : -1;
  instance_names_.push_back({{name, where}, inside});
}

// Depth first, with a stack of its own: objects may be nested deeper than calls.
void SceneState::check_nesting() const {
  constexpr int deepest = 100;
  enum class Visit : uint8_t { none, open, done };
  std::vector<Visit> visits(scene_.objects.size(), Visit::none);
  std::vector<int> depths(scene_.objects.size(), 0);
  for (uint32_t root = 0; root < visits.size(); ++root) {
    if (visits[root] != Visit::none) continue;
    std::vector<std::pair<uint32_t, size_t>> path{{root, 0}};  // object, its next instance
    visits[root] = Visit::open;
    while (!path.empty()) {
      auto& [object, next] = path.back();
      const auto& instances = scene_.objects[object].instances;
      if (next == instances.size()) {
        visits[object] = Visit::done;
        for (const InstanceDescription& inner : instances) {
          depths[object] = std::max(depths[object], depths[inner.object] + 1);
          if (depths[object] > deepest)
            fail(inner.where, "objects are nested more than " + std::to_string(deepest) + " deep");
        }
        path.pop_back();
        continue;
      }
      const InstanceDescription& instance = instances[next++];
      if (visits[instance.object] == Visit::open)
        fail(instance.where, "object \"" + scene_.objects[instance.object].name +
                                 "\" would contain itself by this instance");
      if (visits[instance.object] == Visit::none) {
        visits[instance.object] = Visit::open;
        path.emplace_back(instance.object, 0);
      }
    }
  }
}

TransformPair SceneState::placement(const Location& where) const {
  for (const Location& singular : now_.singular)
    if (singular.line != 0)
      fail(singular, "this makes the transformation singular; it is used at " + to_string(where));
  TransformPair result{now_.ctm[0], nullptr, now_.steps};
  if (now_.ctm[0].matrix() != now_.ctm[1].matrix())
    result.end = std::make_shared<const Transform>(now_.ctm[1]);
  return result;
}

// The first culprit stays; the transformation itself stays what it was before.
void SceneState::set_singular(size_t i, const Location& where) {
  if (now_.singular[i].line == 0) now_.singular[i] = where;
}

void SceneState::concatenate(const Transform& t, const Location& where) {
  for (size_t i = 0; i < 2; ++i) {
    if (!now_.active[i]) continue;
    const Transform product = now_.ctm[i] * t;
    if (all_finite(product.matrix()) && all_finite(product.inverse_matrix()))
      now_.ctm[i] = product;
    else
      set_singular(i, where);
  }
}

void SceneState::concatenate(const dmat4& m, const Location& where) {
  if (Transform::is_invertible(m)) return concatenate(Transform(m), where);
  for (size_t i = 0; i < 2; ++i)
    if (now_.active[i]) set_singular(i, where);
}

void SceneState::replace(const dmat4& m, const Location& where) {
  for (size_t i = 0; i < 2; ++i)
    if (now_.active[i]) now_.singular[i] = {};
  if (!Transform::is_invertible(m)) return concatenate(m, where);
  for (size_t i = 0; i < 2; ++i)
    if (now_.active[i]) now_.ctm[i] = Transform(m);
}

void SceneState::define_coordinates(const std::string& name, const Location& where) {
  scene_.coordinate_systems[name] = placement(where);
}

void SceneState::use_coordinates(const std::string& name, const Location& where) {
  const auto found = scene_.coordinate_systems.find(name);
  if (found == scene_.coordinate_systems.end()) {
    std::vector<std::string> known;
    for (const auto& entry : scene_.coordinate_systems) known.push_back(entry.first);
    fail(where, "coordinate system \"" + name + "\" is not defined" + suggestion(name, known));
  }
  const TransformPair& t = found->second;
  now_.ctm = {t.start, t.animated() ? *t.end : t.start};
  now_.singular = {};
  now_.steps = t.steps;
}

void SceneState::record_step(std::string text, bool replaces) {
  const bool all = now_.active[0] && now_.active[1];
  now_.steps = std::make_shared<TransformStep>(std::move(text), now_.active,
                                               replaces && all ? nullptr : now_.steps);
}

void SceneState::transform_times(float start, float end, const Location& where) {
  if (!(start <= end)) fail(where, "TransformTimes: the start is after the end");
  now_.start_time = start;
  now_.end_time = end;
}

SceneState::Import::Import(SceneState& state)
    : state_(state),
      saved_(state.now_),
      coordinates_(state.scene_.coordinate_systems),
      base_(std::exchange(state.import_base_, state.pushed_.size())) {}

void SceneState::Import::finish() {
  if (state_.pushed_.size() > state_.import_base_) state_.fail_unclosed(state_.pushed_.back());
  state_.now_ = std::move(saved_);
  state_.scene_.coordinate_systems = std::move(coordinates_);
  state_.import_base_ = base_;
}

}  // namespace pssmlt
