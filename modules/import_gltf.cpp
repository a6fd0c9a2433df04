// glTF 2.0 files (.gltf, .glb) as scenes, and as parts of text scenes (Import "model.glb").
//
// Source: Khronos Group 2021, glTF 2.0 Specification, and the extensions that docs/gltf.md lists.
// Read by tinygltf; images stay what they are and are decoded by the textures that show them. What
// is made are the directives that a text would have: core/scene/import.h.
#include <algorithm>

#include "core/plugin/plugin.h"
#include "core/scene/import.h"
#include "modules/gltf/accessor.h"
#include "modules/gltf/endpoints.h"
#include "modules/gltf/material.h"
#include "modules/gltf/mesh.h"
#include "modules/gltf/nodes.h"

namespace pssmlt::gltf {
namespace {

// A shape before it is declared.
struct Piece {
  MeshPiece mesh;
  const ShapeSurface* surface = nullptr;
  std::string pointer;
};

class Importer {
 public:
  Importer(const ImportedFile& file, const ImportTarget& target)
      : file_(file),
        target_(target),
        document_(file.path, file.label),
        materials_(document_, target),
        nodes_(walk_nodes(document_)) {}

  void run() {
    remember_contents();
    count_uses();
    if (file_.whole_scene) {
      const bool has_camera = !camera_names(document_, nodes_).empty();
      declare_camera(document_, target_, nodes_, has_camera ? Bounds() : bounds());
      target_.state.world_begin(document_.at("scenes"));
    }
    const int lights = declare_lights(document_, target_, nodes_);
    declare_shapes();
    if (lights > 0)
      note("lights are in candela and lux, emission in nits: the picture is in nits (cd/m^2)");
    if (file_.whole_scene && lights == 0 && !emits_) light_all_around();
    write_notes();
  }

 private:
  const tinygltf::Model& model() const { return document_.model(); }
  const tinygltf::Node& node(const PlacedNode& placed) const {
    return model().nodes[static_cast<size_t>(placed.node)];
  }
  void note(const std::string& line) { target_.log.push_back(file_.path + ": " + line); }

  void remember_contents() {
    target_.scene.files_read.push_back(file_.path);
    for (const std::string_view bytes : document_.contents()) hash_text(target_.scene.hash, bytes);
  }

  // Meshes that stand in several places, the same in each, become objects.
  void count_uses() {
    uses_.resize(model().meshes.size());
    for (const PlacedNode& placed : nodes_) {
      const tinygltf::Node& n = node(placed);
      if (n.mesh < 0) continue;
      document_.get(model().meshes, n.mesh, "meshes", element("nodes", placed.node));
      if (is_plain(n)) ++uses_[static_cast<size_t>(n.mesh)];
    }
  }
  static bool is_plain(const tinygltf::Node& n) { return n.skin < 0 && n.weights.empty(); }

  Pose pose(const tinygltf::Node& n) const {
    const tinygltf::Mesh& mesh = model().meshes[static_cast<size_t>(n.mesh)];
    Pose result{n.weights.empty() ? mesh.weights : n.weights, {}};
    if (n.skin >= 0) result.joints = joint_matrices(document_, n.skin, nodes_);
    return result;
  }

  // Of everything, in the world.
  Bounds bounds() {
    Bounds all;
    std::vector<std::optional<Bounds>> known(model().meshes.size());
    for (const PlacedNode& placed : nodes_) {
      const tinygltf::Node& n = node(placed);
      if (n.mesh < 0) continue;
      std::optional<Bounds>& mesh = known[static_cast<size_t>(n.mesh)];
      const bool plain = is_plain(n);
      const Bounds own = plain && mesh ? *mesh : mesh_bounds(n);
      if (plain) mesh = own;
      if (!(own.min.x <= own.max.x)) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const dvec3 p((corner & 1 ? own.max : own.min).x, (corner & 2 ? own.max : own.min).y,
                      (corner & 4 ? own.max : own.min).z);
        const vec3 at = n.skin >= 0 ? vec3(p) : vec3(placed.world * glm::dvec4(p, 1.0));
        if (is_finite(at)) all.add(at);
      }
    }
    return all;
  }
  Bounds mesh_bounds(const tinygltf::Node& n) const {
    Bounds all;
    const auto& primitives = model().meshes[static_cast<size_t>(n.mesh)].primitives;
    for (size_t i = 0; i < primitives.size(); ++i) {
      const auto piece = read_primitive(document_, n.mesh, i, {}, pose(n));
      if (!piece || !(piece->bounds.min.x <= piece->bounds.max.x)) continue;
      all.add(piece->bounds.min);
      all.add(piece->bounds.max);
    }
    return all;
  }

  std::vector<Piece> pieces(const tinygltf::Node& n) {
    std::vector<Piece> result;
    const auto& primitives = model().meshes[static_cast<size_t>(n.mesh)].primitives;
    const Pose bent = pose(n);
    for (size_t i = 0; i < primitives.size(); ++i) {
      const std::string pointer = primitive_pointer(n.mesh, i);
      const ShapeSurface& surface = materials_.get(
          primitives[i].material, primitives[i].attributes.contains("COLOR_0"), pointer);
      auto mesh = read_primitive(document_, n.mesh, i, surface.needs, bent);
      if (mesh)
        result.push_back({std::move(*mesh), &surface, pointer});
      else
        ++skipped_;
    }
    return result;
  }

  void declare_shapes() {
    objects_.resize(model().meshes.size());
    for (const PlacedNode& placed : nodes_) {
      const tinygltf::Node& n = node(placed);
      if (n.mesh < 0) continue;
      // A node scaled to nothing shows nothing; a skin takes its place from its joints.
      if (n.skin < 0 && !Transform::is_invertible(placed.world)) continue;
      const Location where = document_.at(element("nodes", placed.node));
      target_.state.push(SceneState::Nested::Attribute, where);
      if (n.skin < 0) target_.state.concatenate(placed.world, where);
      const bool shared = is_plain(n) && uses_[static_cast<size_t>(n.mesh)] > 1;
      if (shared && !target_.state.in_object())
        instance(n, where);
      else
        for (Piece& piece : pieces(n)) declare(std::move(piece));
      target_.state.pop(SceneState::Nested::Attribute, where);
    }
  }

  // The pieces that emit are shapes of their own in each place: objects hold no lights.
  struct Object {
    std::string name;  // "": not declared yet
    bool empty = true;
    std::vector<Piece> emitting;
  };
  void instance(const tinygltf::Node& n, const Location& where) {
    Object& object = objects_[static_cast<size_t>(n.mesh)];
    if (object.name.empty()) {
      object.name = document_.label() + ": " + element("meshes", n.mesh);
      const Location here = document_.at(element("meshes", n.mesh));
      target_.state.push(SceneState::Nested::Attribute, here);
      target_.state.replace(dmat4(1.0), here);
      target_.state.object_begin(object.name, here);
      for (Piece& piece : pieces(n)) {
        if (piece.surface->emission) {
          object.emitting.push_back(std::move(piece));
        } else {
          object.empty = false;
          declare(std::move(piece));
        }
      }
      target_.state.object_end(here);
      target_.state.pop(SceneState::Nested::Attribute, here);
    }
    if (!object.empty) target_.state.object_instance(object.name, where);
    for (const Piece& piece : object.emitting) declare(piece);
  }

  void declare(Piece piece) {
    const ShapeSurface& surface = *piece.surface;
    const Location where = document_.at(piece.pointer);
    SceneState& state = target_.state;
    state.push(SceneState::Nested::Attribute, where);
    state.use_material(surface.material, where);
    if (!surface.medium.empty())
      state.medium_interface(surface.medium, std::string(state.outside_medium()), where);
    if (surface.emission) {
      state.area_light("diffuse", *surface.emission, where);
      emits_ = true;
    }
    ParameterSet& parameters = piece.mesh.parameters;
    if (surface.alpha) {
      ParameterWriter alpha(where);
      write(alpha, "alpha", *surface.alpha);
      std::ranges::move(alpha.take(), std::back_inserter(parameters));
    }
    state.shape("trianglemesh", std::move(parameters), where);
    state.pop(SceneState::Nested::Attribute, where);
  }

  void light_all_around() {
    const Location where = document_.at("the light all around");
    target_.state.light("infinite", ParameterWriter(where).rgb("L", vec3(1.f)).take(), where);
    note("there is no light: the same light from all around, radiance 1, is used");
  }

  void write_notes() {
    if (skipped_ > 0)
      note(std::to_string(skipped_) + (skipped_ == 1 ? " primitive" : " primitives") +
           " without triangles left out");
    for (const std::string& line : materials_.notes()) note(line);
    for (const std::string& name : document_.unknown_extensions())
      note("the extension " + name + " is not supported: what it adds is left out");
    const std::vector<std::string> cameras = camera_names(document_, nodes_);
    if (!file_.whole_scene && !cameras.empty())
      note("its cameras are not imported: the scene has its own");
    const bool one_sided = std::ranges::any_of(
        model().materials, [](const tinygltf::Material& m) { return !m.doubleSided; });
    if (one_sided) note("materials that are not doubleSided are seen from both sides all the same");
    if (!model().animations.empty()) note("animations are left out: everything is at rest");
  }

  const ImportedFile& file_;
  const ImportTarget& target_;
  Document document_;
  Materials materials_;
  std::vector<PlacedNode> nodes_;
  std::vector<int> uses_;  // of each mesh, where it is as the file has it
  std::vector<Object> objects_;
  int skipped_ = 0;
  bool emits_ = false;
};

}  // namespace
}  // namespace pssmlt::gltf

PSSMLT_EXPORT void pssmlt_import(const pssmlt::ImportedFile& file,
                                 const pssmlt::ImportTarget& target) {
  pssmlt::gltf::Importer(file, target).run();
}

static_assert(std::is_same_v<decltype(pssmlt_import), pssmlt::ImportFunction>);
