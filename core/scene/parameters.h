// Parameters of a scene's directives: ParameterSet is what the file says, Parameters is the face a
// plugin's constructor reads it through. Every read names its default, unit and meaning, so that
// the reference manual is generated from the code, and what was never read is reported.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/rgb.h"
#include "core/base/transform.h"

namespace pssmlt {

template <typename T>
class Texture;
class SceneResolver;

// pbrt-v4's parameter types; aliases (point, vector, normal) are folded by the parser.
// (gcc 12 takes the scoped enumerator Rgb for a shadow of the type Rgb.)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
enum class ParameterType : uint8_t {
  Integer,
  Float,
  Point2,
  Vector2,
  Point3,
  Vector3,
  Normal,
  Bool,
  String,
  Texture,
  Spectrum,
  Rgb,
  Blackbody
};
#pragma GCC diagnostic pop
std::string_view to_string(ParameterType type);

// One parameter as written. Exactly one of the value arrays is filled, by the type: ints (Integer),
// floats (Float, Point*, Vector*, Normal, Rgb, Blackbody, inline Spectrum), strings (String,
// Texture, named or file Spectrum), bools (Bool; 0 or 1).
struct Parameter {
  ParameterType type;
  std::string name;
  Location where;  // of the declaration
  std::vector<int> ints;
  std::vector<float> floats;
  std::vector<std::string> strings;
  std::vector<uint8_t> bools;
  std::shared_ptr<const std::string> color_space;  // in force where it was written: "srgb", ...
  mutable bool was_read = false;
};
using ParameterSet = std::vector<Parameter>;

// What an RGB or spectrum parameter stands for; it decides how spectra become Rgb.
enum class SpectrumUse { Albedo, Illuminant, Unbounded };

// How a parameter is described in the manual.
struct ParameterDoc {
  std::string name, type, fallback, unit, doc;
};

// Reads a ParameterSet, which must outlive it. Not shared between threads.
class Parameters {
 public:
  // set: as written; where: of the directive; owner: e.g. `material "diffuse"` for messages;
  // resolver: finds textures, spectra, files (null: allowed only while describing).
  Parameters(const ParameterSet& set, Location where, std::string owner, SceneResolver* resolver);
  // A reader that records what is read into `docs` and answers every read with its default.
  static Parameters describing(std::vector<ParameterDoc>& docs);
  // True while the manual is made: a constructor returns right after its reads.
  bool describing() const { return docs_ != nullptr; }

  // Scalars: the value as written or the fallback. Throws Error with the parameter's location on
  // the wrong type or number of values, and on NaN or Inf. `unit` is "" for dimensionless numbers.
  float number(std::string_view name, float fallback, std::string_view unit, std::string_view doc);
  int integer(std::string_view name, int fallback, std::string_view unit, std::string_view doc);
  bool flag(std::string_view name, bool fallback, std::string_view doc);
  std::string text(std::string_view name, std::string_view fallback, std::string_view doc);
  // One of `choices`; an Error with a suggestion otherwise.
  std::string choice(std::string_view name, std::string_view fallback,
                     std::span<const std::string_view> choices, std::string_view doc);
  // A file name resolved as pbrt does (against the directory of the scene's first file); "" if not
  // given. Throws Error if the file does not exist.
  std::string file(std::string_view name, std::string_view doc);
  vec3 point(std::string_view name, const vec3& fallback, std::string_view unit,
             std::string_view doc);
  vec3 vector(std::string_view name, const vec3& fallback, std::string_view doc);
  // A colour from rgb, spectrum (named, file, inline samples) or blackbody.
  Rgb rgb(std::string_view name, const Rgb& fallback, SpectrumUse use, std::string_view unit,
          std::string_view doc);
  // A wavelength-dependent quantity for those who need more than RGB (Fresnel of metals): samples
  // (wavelength [nm], value) if the parameter is a spectrum, nullopt if not given or given as rgb.
  std::optional<std::vector<vec2>> spectrum(std::string_view name, std::string_view unit,
                                            std::string_view doc);

  // Arrays: empty if not given.
  std::vector<float> numbers(std::string_view name, std::string_view unit, std::string_view doc);
  std::vector<int> integers(std::string_view name, std::string_view unit, std::string_view doc);
  std::vector<vec2> points2(std::string_view name, std::string_view unit, std::string_view doc);
  std::vector<vec3> points3(std::string_view name, std::string_view unit, std::string_view doc);
  std::vector<vec3> vectors3(std::string_view name, std::string_view doc);
  std::vector<vec3> normals(std::string_view name, std::string_view doc);
  std::vector<std::string> texts(std::string_view name, std::string_view doc);
  // Only of type rgb (grids of colours), taken as linear components of the scene's colour space.
  std::vector<Rgb> rgbs(std::string_view name, std::string_view unit, std::string_view doc);

  // Textures: a named texture, or a constant from the value given, or from the fallback.
  std::shared_ptr<const Texture<float>> float_texture(std::string_view name, float fallback,
                                                      std::string_view unit, std::string_view doc);
  std::shared_ptr<const Texture<Rgb>> rgb_texture(std::string_view name, const Rgb& fallback,
                                                  SpectrumUse use, std::string_view unit,
                                                  std::string_view doc);
  // As float_texture, null if not given (alpha, displacement, bump).
  std::shared_ptr<const Texture<float>> optional_float_texture(std::string_view name,
                                                               std::string_view doc);

  // True if the scene gives the parameter (does not count as reading it).
  bool has(std::string_view name) const;
  // The type it is given with, for parameters that may be several things ("float eta" or
  // "spectrum eta"); nullopt if not given. Does not count as reading it.
  std::optional<ParameterType> type(std::string_view name) const;
  // Throws an Error naming the first parameter that nobody read, with a suggestion from the names
  // that were asked for.
  void check_all_read() const;
  // An Error at this directive, for constructors that find their values inconsistent.
  [[noreturn]] void fail(const std::string& message) const;
  // Same, at the named parameter if the scene gives it.
  [[noreturn]] void fail(std::string_view name, const std::string& message) const;

  // A line for the user: what was read but is not followed, and why. Nothing while describing.
  void note(const std::string& message) const;

  const Location& where() const { return where_; }
  const std::string& owner() const { return owner_; }
  SceneResolver& resolver() const { return *resolver_; }
  // The current transformation matrix of the directive: its space to render space (shapes, lights,
  // cameras, and textures' mappings).
  const Transform& transform() const { return transform_; }
  void set_transform(const Transform& t) { transform_ = t; }
  // World space to render space, for what is given in world space wherever it stands.
  const Transform& world() const { return world_; }
  void set_world(const Transform& t) { world_ = t; }
  // ReverseOrientation was in force (shapes).
  bool reverse_orientation() const { return reverse_orientation_; }
  void set_reverse_orientation(bool r) { reverse_orientation_ = r; }

 private:
  Parameters() = default;
  // The parameter as written if it has one of the types, null if it is not given; remembers that
  // the name was asked for. Throws Error on another type.
  const Parameter* find(std::string_view name, std::initializer_list<ParameterType> accepted);
  // The same for exactly one value (a point is one value of three numbers).
  const Parameter* find_one(std::string_view name, std::initializer_list<ParameterType> accepted);
  [[noreturn]] void fail_at(const Parameter& p, const std::string& message) const;
  void check_finite(const Parameter& p) const;
  template <typename V>
  std::vector<V> tuples(std::string_view name, ParameterType type, std::string_view unit,
                        std::string_view doc);
  void document(std::string_view name, std::string_view type, std::string fallback,
                std::string_view unit, std::string_view doc);

  const ParameterSet* set_ = nullptr;
  Location where_;
  std::string owner_;
  SceneResolver* resolver_ = nullptr;
  Transform transform_, world_;
  bool reverse_orientation_ = false;
  std::vector<ParameterDoc>* docs_ = nullptr;
  std::vector<std::string> asked_;
};

// What a plugin's constructor may ask of the scene being built.
class SceneResolver {
 public:
  virtual ~SceneResolver() = default;
  // Named texture declared earlier; throws Error at `where` with a suggestion if there is none.
  virtual std::shared_ptr<const Texture<float>> float_texture(const std::string& name,
                                                              const Location& where) = 0;
  virtual std::shared_ptr<const Texture<Rgb>> rgb_texture(const std::string& name,
                                                          const Location& where) = 0;
  // Absolute path of a file named in the scene.
  virtual std::string resolve_path(const std::string& name) const = 0;
  // Material by name (for mix); throws Error at `where`.
  virtual std::shared_ptr<const class Material> material(const std::string& name,
                                                         const Location& where) = 0;
  // A line for the log of the render.
  virtual void note(const std::string& line) { static_cast<void>(line); }
};

}  // namespace pssmlt
