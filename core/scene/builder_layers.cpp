#include "core/scene/builder_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

#include "core/plugin/registry.h"
#include "core/scene/builder_resolver.h"
#include "core/scene/integrator_choice.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

// What "--set" may name.
constexpr std::array<std::string_view, 3> owners = {"integrator", "sampler", "camera"};

template <typename T>
T parse_number(const std::string& text, const std::string& assignment) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error("--set " + assignment + ": \"" + text + "\" is not a number of the right type");
  }
  return value;
}

// A parameter from its text, typed as the plugin documents it.
Parameter typed_parameter(const ParameterDoc& doc, const std::string& text,
                          const std::string& assignment) {
  Parameter p;
  p.name = doc.name;
  if (doc.type.starts_with("integer")) {
    p.type = ParameterType::Integer;
    p.ints = {parse_number<int>(text, assignment)};
  } else if (doc.type.starts_with("float")) {
    p.type = ParameterType::Float;
    p.floats = {parse_number<float>(text, assignment)};
  } else if (doc.type.starts_with("bool")) {
    if (text != "true" && text != "false") {
      throw Error("--set " + assignment + ": must be true or false");
    }
    p.type = ParameterType::Bool;
    p.bools = {static_cast<uint8_t>(text == "true")};
  } else if (doc.type.starts_with("string")) {
    p.type = ParameterType::String;
    p.strings = {text};
  } else {
    throw Error("--set " + assignment + ": a parameter of type " + doc.type +
                " can only be given in the scene");
  }
  return p;
}

void set_parameter(ParameterSet& set, Parameter parameter) {
  std::erase_if(set, [&](const Parameter& p) { return p.name == parameter.name; });
  set.push_back(std::move(parameter));
}

// The scene's directive, or the command line's choice with those of the scene's parameters that the
// chosen plugin has too.
Directive choose(const Directive& scene, const std::optional<std::string>& chosen,
                 const std::string& fallback) {
  Directive d = scene;
  if (chosen) d.type = *chosen;
  if (d.type.empty()) d.type = fallback;
  return d;
}

// What the plugin that the scene names knows is none of the chosen one's, however near its name.
bool knows(const std::string& kind, const std::string& plugin, const std::string& parameter) {
  if (plugin.empty()) return false;
  try {
    const FoundPlugin found = Registry::instance().find(kind, plugin, {});
    return std::ranges::any_of(describe(*found.descriptor),
                               [&](const ParameterDoc& doc) { return doc.name == parameter; });
  } catch (const Error&) {
    return false;
  }
}

// written: the type in the scene.
void drop_unknown(const std::vector<ParameterDoc>& docs, const std::string& kind,
                  const std::string& written, Directive& d, std::vector<std::string>& log) {
  std::vector<std::string> names;
  for (const ParameterDoc& doc : docs) names.push_back(doc.name);
  std::erase_if(d.parameters, [&](const Parameter& p) {
    // What is nearly a known name is a slip of the pen, which check_all_read() tells.
    const bool known = std::ranges::find(names, p.name) != names.end() ||
                       (!suggestion(p.name, names).empty() && !knows(kind, written, p.name));
    if (!known) {
      log.push_back("the scene's parameter \"" + p.name + "\" does not apply to the chosen " +
                    owner_name(kind, d.type));
    }
    return !known;
  });
}

void describe_settings(const std::string& kind, const Directive& d, std::string& settings) {
  settings += kind + " " + d.type + "\n";
  for (const Parameter& p : d.parameters) {
    settings += " " + p.name;
    for (const int v : p.ints) settings += " " + std::to_string(v);
    for (const float v : p.floats) settings += " " + std::to_string(std::bit_cast<uint32_t>(v));
    for (const std::string& v : p.strings) settings += " \"" + v + "\"";
    for (const uint8_t v : p.bools) settings += v ? " true" : " false";
    settings += "\n";
  }
}

// As text: the value of a parameter of any type.
std::string value_text(const Parameter& p) {
  std::string text;
  const auto add = [&text](const std::string& one) { text += (text.empty() ? "" : " ") + one; };
  for (const int v : p.ints) add(std::to_string(v));
  for (const float v : p.floats) add(fmt::format("{}", v));
  for (const std::string& v : p.strings) add(v);
  for (const uint8_t v : p.bools) add(v ? "true" : "false");
  return text;
}

PluginValues values_in_force(const std::vector<ParameterDoc>& docs, const Directive& d) {
  PluginValues values;
  for (const ParameterDoc& doc : docs) {
    const auto given = std::ranges::find(d.parameters, doc.name, &Parameter::name);
    std::string value = given == d.parameters.end() ? doc.fallback : value_text(*given);
    std::erase(value, '"');
    values.emplace_back(doc.name, std::move(value));
  }
  return values;
}

template <typename Kind>
std::shared_ptr<Kind> make(const std::string& kind, const FoundPlugin& found, const Directive& d,
                           SceneResolver& resolver) {
  for (const Parameter& p : d.parameters) p.was_read = false;
  Parameters parameters(d.parameters, d.where, owner_name(kind, d.type), &resolver);
  return make_plugin<Kind>(found, parameters);
}

// An alias that stands for integrator and sampler (a Metropolis integrator of pbrt's) hands the
// parameters that the integrator does not know to the sampler.
void split_alias(const FoundPlugin& found, Directive& integrator, Directive& sampler) {
  const auto docs = describe(*found.descriptor);
  ParameterSet kept;
  sampler.parameters.clear();
  for (Parameter& p : integrator.parameters) {
    const bool known = std::ranges::find(docs, p.name, &ParameterDoc::name) != docs.end();
    (known ? kept : sampler.parameters).push_back(std::move(p));
  }
  integrator.parameters = std::move(kept);
  sampler.type = found.sampler;
}

void log_alias(const std::string& kind, const FoundPlugin& found, std::vector<std::string>& log) {
  if (found.alias.empty()) return;
  std::string line =
      owner_name(kind, found.alias) + " stands for \"" + found.descriptor->name + "\"";
  if (!found.sampler.empty()) line += " under sampler \"" + found.sampler + "\"";
  log.push_back(line);
}

// What the layer's integrator or sampler is made from.
struct Choice {
  std::string written;  // type in the scene
  Directive directive;
  FoundPlugin found;
  std::vector<ParameterDoc> docs;
};

void add_new(std::vector<ParameterDoc>& docs, const std::vector<ParameterDoc>& more) {
  for (const ParameterDoc& doc : more) {
    if (std::ranges::find(docs, doc.name, &ParameterDoc::name) == docs.end()) docs.push_back(doc);
  }
}

// All integrators there are, each with those of the directive's parameters that it has.
void make_choice(const Directive& scene, const BuildOptions& options, SceneResolver& resolver,
                 std::string& settings, std::vector<std::string>& log, Layer& layer) {
  Registry& registry = Registry::instance();
  std::vector<std::pair<FoundPlugin, std::vector<ParameterDoc>>> found;
  std::vector<ParameterDoc> docs;
  for (const std::string& name : registry.names("integrator")) {
    try {
      const FoundPlugin one = registry.find("integrator", name, scene.where);
      found.emplace_back(one, describe(*one.descriptor));
      add_new(docs, found.back().second);
    } catch (const Error& error) {
      log.push_back("integrator \"" + name + "\" is left out: " + error.what());
    }
  }
  Directive all = scene;
  all.type = layer.integrator_name;
  drop_unknown(docs, "integrator", scene.type, all, log);
  apply_assignments(options.set, "integrator", docs, all);
  describe_settings("integrator", all, settings);
  layer.integrator_values = values_in_force(docs, all);
  std::vector<IntegratorChoice::Named> choice;
  for (const auto& [one, known] : found) {
    Directive its = all;
    its.type = one.descriptor->name;
    std::erase_if(its.parameters, [&, &known = known](const Parameter& p) {
      return std::ranges::find(known, p.name, &ParameterDoc::name) == known.end();
    });
    settings += "or " + its.type + "\n";
    choice.push_back({its.type, make<Integrator>("integrator", one, its, resolver)});
  }
  layer.integrator = std::make_shared<IntegratorChoice>(std::move(choice));
}

void make_integrator(Choice& c, const BuildOptions& options, SceneResolver& resolver,
                     std::string& settings, Layer& layer) {
  apply_assignments(options.set, "integrator", c.docs, c.directive);
  describe_settings("integrator", c.directive, settings);
  layer.integrator = make<Integrator>("integrator", c.found, c.directive, resolver);
  layer.integrator_name = c.found.descriptor->name;
  layer.integrator_values = values_in_force(c.docs, c.directive);
}

void make_sampler(Choice& c, const BuildOptions& options, SceneResolver& resolver,
                  std::string& settings, std::vector<std::string>& log, Layer& layer) {
  c.found = Registry::instance().find("sampler", c.directive.type, c.directive.where);
  log_alias("sampler", c.found, log);
  c.docs = describe(*c.found.descriptor);
  // An alias' parameters are another plugin's: what ours does not know is said, not refused.
  if (options.sampler || !c.found.alias.empty())
    drop_unknown(c.docs, "sampler", c.written, c.directive, log);
  apply_assignments(options.set, "sampler", c.docs, c.directive);
  describe_settings("sampler", c.directive, settings);
  layer.sampler = make<Sampler>("sampler", c.found, c.directive, resolver);
  layer.sampler_name = c.found.descriptor->name;
  layer.sampler_values = values_in_force(c.docs, c.directive);
}

Layer build_layer(const LayerDescription& description, const BuildOptions& options,
                  SceneResolver& resolver, std::string& settings, std::vector<std::string>& log) {
  Layer layer;
  layer.name = description.name;
  const bool named = options.integrator || !description.integrator.type.empty();
  Choice integrator, sampler;
  integrator.written = description.integrator.type;
  sampler.written = description.sampler.type;
  integrator.directive =
      choose(description.integrator, options.integrator, options.defaults.integrator);
  sampler.directive = choose(description.sampler, options.sampler, options.defaults.sampler);
  integrator.found = Registry::instance().find("integrator", integrator.directive.type,
                                               integrator.directive.where);
  // --sampler overrules what an alias implies.
  if (!integrator.found.sampler.empty()) {
    split_alias(integrator.found, integrator.directive, sampler.directive);
    if (options.sampler) sampler.directive.type = *options.sampler;
  }
  make_sampler(sampler, options, resolver, settings, log, layer);
  if (layer.sampler->chooses_integrator() && !options.integrator && (options.sampler || !named)) {
    layer.integrator_name = layer.sampler_name;
    make_choice(integrator.directive, options, resolver, settings, log, layer);
    return layer;
  }
  log_alias("integrator", integrator.found, log);
  integrator.docs = describe(*integrator.found.descriptor);
  if (options.integrator || !integrator.found.alias.empty()) {
    drop_unknown(integrator.docs, "integrator", integrator.written, integrator.directive, log);
  }
  make_integrator(integrator, options, resolver, settings, layer);
  return layer;
}

}  // namespace

void apply_assignments(const std::vector<std::string>& set, const std::string& owner,
                       const std::vector<ParameterDoc>& docs, Directive& directive) {
  for (const std::string& assignment : set) {
    const size_t dot = assignment.find('.'), equals = assignment.find('=');
    if (dot == std::string::npos || equals == std::string::npos || dot > equals) {
      throw Error("--set " + assignment + ": must look like integrator.maxdepth=8");
    }
    const std::string given = assignment.substr(0, dot);
    if (std::ranges::find(owners, given) == owners.end()) {
      throw Error("--set " + assignment + ": \"" + given +
                  "\" has no parameters to set; integrator, sampler and camera have");
    }
    if (given != owner) continue;
    const std::string name = assignment.substr(dot + 1, equals - dot - 1);
    const auto doc = std::ranges::find(docs, name, &ParameterDoc::name);
    if (doc == docs.end()) {
      std::vector<std::string> known;
      for (const ParameterDoc& d : docs) known.push_back(d.name);
      throw Error("--set " + assignment + ": " + owner_name(owner, directive.type) +
                  " has no parameter \"" + name + "\"" + suggestion(name, known));
    }
    set_parameter(directive.parameters,
                  typed_parameter(*doc, assignment.substr(equals + 1), assignment));
  }
}

std::vector<Layer> build_layers(const SceneDescription& scene, const BuildOptions& options,
                                std::string& settings, std::vector<std::string>& log) {
  BuildResolver resolver(scene, Transform(), options.defaults.material, log);
  std::vector<Layer> layers;
  for (const LayerDescription& description : scene.layers) {
    Parameters(description.parameters, description.where, "layer", &resolver).check_all_read();
    settings += "layer " + description.name + "\n";
    layers.push_back(build_layer(description, options, resolver, settings, log));
  }
  return layers;
}

}  // namespace pssmlt
