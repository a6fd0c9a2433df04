#include "modules/gltf/texture.h"

#include <filesystem>
#include <numbers>

namespace pssmlt::gltf {
namespace {
namespace fs = std::filesystem;

constexpr const char* transform_extension = "KHR_texture_transform";

void read_transform(const tinygltf::Value& v, TextureReference& t) {
  const auto pair = [&](const char* name, const dvec2& fallback) {
    const std::vector<double> found = numbers(v, name);
    return found.size() == 2 ? dvec2(found[0], found[1]) : fallback;
  };
  t.offset = pair("offset", t.offset);
  t.scale = pair("scale", t.scale);
  t.rotation = number(v, "rotation", 0.0);
  t.set = integer(v, "texCoord", t.set);
}

const char* wrap_name(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return "clamp";
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? "mirror" : "repeat";
}

// By the first bytes, which the type that the file states may contradict.
std::string ending_of(std::span<const unsigned char> bytes, const std::string& mime_type) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG")) return "png";
  if (text.starts_with("\xFF\xD8")) return "jpg";
  if (text.starts_with("RIFF") && text.size() > 12 && text.substr(8, 4) == "WEBP") return "webp";
  const size_t slash = mime_type.find('/');
  return slash == std::string::npos ? "" : mime_type.substr(slash + 1);
}

// "%20" and the like.
std::string decoded(const std::string& uri) {
  std::string result;
  for (size_t i = 0; i < uri.size(); ++i) {
    const auto digit = [&](size_t k) {
      return k < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[k])) != 0;
    };
    if (uri[i] == '%' && digit(i + 1) && digit(i + 2)) {
      result += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

}  // namespace

TextureReference texture_reference(int index, int set, const tinygltf::ExtensionMap& extensions) {
  TextureReference t;
  t.index = index;
  t.set = set;
  if (const auto* const v = extension(extensions, transform_extension)) read_transform(*v, t);
  return t;
}

TextureReference texture_reference(const tinygltf::Value& object, const char* name) {
  TextureReference t;
  if (!object.IsObject() || !object.Has(name)) return t;
  const tinygltf::Value& info = object.Get(name);
  t.index = integer(info, "index", -1);
  t.set = integer(info, "texCoord", 0);
  if (info.IsObject() && info.Has("extensions")) {
    const tinygltf::Value& extensions = info.Get("extensions");
    if (extensions.IsObject() && extensions.Has(transform_extension))
      read_transform(extensions.Get(transform_extension), t);
  }
  return t;
}

void write(ParameterWriter& out, const char* name, const FloatValue& value) {
  if (value.texture.empty())
    out.number(name, value.constant);
  else
    out.texture(name, value.texture);
}

void write(ParameterWriter& out, const char* name, const ColorValue& value) {
  if (value.texture.empty())
    out.rgb(name, value.constant);
  else
    out.texture(name, value.texture);
}

std::string Textures::declare(const Context& context, const char* role, const char* type,
                              bool color, ParameterSet parameters) {
  std::string name = context.name + "." + role;
  target_.state.texture(name, color ? "spectrum" : "float", type, std::move(parameters),
                        context.where);
  return name;
}

std::string Textures::embedded(int index) {
  const tinygltf::Image& image = document_.model().images[static_cast<size_t>(index)];
  const std::string pointer = element("images", index);
  EmbeddedFile file;
  file.name = document_.label() + ": " + pointer;
  if (image.bufferView >= 0) {
    const auto bytes = document_.view(image.bufferView, pointer);
    file.bytes.assign(bytes.begin(), bytes.end());
  } else {
    file.bytes = image.image;
  }
  file.ending = ending_of(file.bytes, image.mimeType);
  if (file.ending.empty()) document_.fail(pointer, "is no image of a known format");
  target_.scene.embedded.push_back(embed_file(std::move(file)));
  return target_.scene.embedded.back()->name;
}

std::string Textures::image_name(int index, const std::string& pointer) {
  const tinygltf::Texture& texture =
      document_.get(document_.model().textures, index, "textures", pointer);
  const std::string here = element("textures", index);
  int source = texture.source;
  if (const auto* const webp = extension(texture.extensions, "EXT_texture_webp"))
    source = integer(*webp, "source", source);
  if (source < 0) {
    std::string names;
    for (const auto& entry : texture.extensions) names += " " + entry.first;
    document_.fail(here, "has no image of a format that is supported" +
                             (names.empty() ? "" : ", only by" + names));
  }
  const tinygltf::Image& image = document_.get(document_.model().images, source, "images", here);
  std::string& name = images_[source];
  if (!name.empty()) return name;
  if (image.uri.empty()) return name = embedded(source);
  const fs::path file = fs::path(document_.path()).parent_path() / decoded(image.uri);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    document_.fail(element("images", source), "there is no file '" + file.string() + "'");
  return name = fs::absolute(file).string();
}

ParameterWriter Textures::image_map(const Context& context, const TextureReference& t) {
  ParameterWriter out(context.where);
  out.text("filename", image_name(t.index, context.pointer));
  const tinygltf::Texture& texture =
      document_.get(document_.model().textures, t.index, "textures", context.pointer);
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = document_.get(document_.model().samplers, texture.sampler,
                                                     "samplers", element("textures", t.index));
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) out.text("filter", "point");
    out.text("uwrap", wrap_name(sampler.wrapS)).text("vwrap", wrap_name(sampler.wrapT));
  }
  if (t.set != context.sets[0] && t.set == context.sets[1]) out.integer("uvset", 1);
  // With v' = 1 - v that grows upward, (u, v) -> offset + R(-r) (scale (u, v)) is a turn by r
  // counter-clockwise about another point.
  const double sine = std::sin(t.rotation), cosine = std::cos(t.rotation);
  out.number("uscale", t.scale.x).number("vscale", t.scale.y);
  out.number("uvrotation", t.rotation * 180.0 / std::numbers::pi);
  out.number("udelta", t.offset.x + sine * t.scale.y);
  out.number("vdelta", 1.0 - t.offset.y - cosine * t.scale.y);
  return out;
}

FloatValue Textures::channel(const Context& context, const char* role,
                             const TextureReference& texture, const char* channel, double factor) {
  if (!texture || factor == 0.0) return {factor, ""};
  ParameterWriter out = image_map(context, texture);
  out.text("channel", channel).text("encoding", "linear").number("scale", factor);
  return {factor, declare(context, role, "imagemap", false, out.take())};
}

ColorValue Textures::color(const Context& context, const char* role,
                           const TextureReference& texture, const vec3& factor, bool encoded) {
  if (!texture || factor == vec3(0.f)) return {factor, ""};
  ParameterWriter out = image_map(context, texture);
  out.text("encoding", encoded ? "sRGB" : "linear");
  const bool grey = factor.x == factor.y && factor.y == factor.z;
  if (grey) {
    out.number("scale", static_cast<double>(factor.x));
    return {factor, declare(context, role, "imagemap", true, out.take())};
  }
  const std::string image_role = std::string(role) + ".image";
  const std::string image = declare(context, image_role.c_str(), "imagemap", true, out.take());
  ParameterWriter product(context.where);
  product.texture("tex1", image).rgb("tex2", factor);
  return {factor, declare(context, role, "product", true, product.take())};
}

ColorValue Textures::by_vertex_color(const Context& context, const char* role,
                                     const ColorValue& value) {
  const std::string base = std::string(role) + ".vertices";
  const std::string vertices = declare(context, base.c_str(), "vertexcolor", true, {});
  ParameterWriter product(context.where);
  product.texture("tex1", vertices);
  write(product, "tex2", value);
  const std::string result = std::string(role) + ".product";
  return {value.constant, declare(context, result.c_str(), "product", true, product.take())};
}

FloatValue Textures::by_vertex_opacity(const Context& context, const char* role,
                                       const FloatValue& value) {
  const std::string base = std::string(role) + ".vertices";
  const std::string vertices = declare(context, base.c_str(), "vertexcolor", false, {});
  ParameterWriter product(context.where);
  product.texture("tex1", vertices);
  write(product, "tex2", value);
  const std::string result = std::string(role) + ".product";
  return {value.constant, declare(context, result.c_str(), "product", false, product.take())};
}

FloatValue Textures::threshold(const Context& context, const char* role, const FloatValue& value,
                               double cutoff) {
  if (value.texture.empty()) return {value.constant >= cutoff ? 1.0 : 0.0, ""};
  ParameterWriter out(context.where);
  out.texture("tex", value.texture).number("value", cutoff);
  const std::string result = std::string(role) + ".cut";
  return {1.0, declare(context, result.c_str(), "threshold", false, out.take())};
}

}  // namespace pssmlt::gltf
