// pssmlt plugins: the reference of every plugin's parameters, made by the plugins themselves.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>

#include "app/parse_arguments.h"
#include "core/plugin/registry.h"

namespace pssmlt {
namespace {

void print(const std::string& text) { std::puts(text.c_str()); }

FoundPlugin find(const std::string& kind, const std::string& name) {
  return Registry::instance().find(kind, name, Location{});
}

std::string aliases(const PluginDescriptor& d) {
  std::string text;
  for (int i = 0; i < d.alias_count; ++i) {
    text += (text.empty() ? "" : ", ") + std::string(d.aliases[i].name);
    if (d.aliases[i].sampler[0] != '\0') {
      text += fmt::format(" (under {})", d.aliases[i].sampler);
    }
  }
  return text;
}

// A bar would end a table's cell.
std::string cell(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

// What kind of value a texture has, if only one; "" otherwise.
std::string only_form(const PluginDescriptor& d) {
  if (std::string(d.kind) != "Texture" || (d.create && d.create_rgb)) return "";
  return d.create ? "Only as a float texture." : "Only as a spectrum texture.";
}

void print_markdown(const std::string& kind, const std::string& name) {
  const PluginDescriptor& d = *find(kind, name).descriptor;
  print(fmt::format("### {} \"{}\"\n\n{}\n", kind, name, d.summary));
  if (d.alias_count != 0) print("Also called: " + aliases(d) + ".\n");
  if (const std::string only = only_form(d); !only.empty()) print(only + "\n");
  const std::vector<ParameterDoc> parameters = describe(d);
  if (parameters.empty()) return print("No parameters.\n");
  print("| parameter | type | default | unit | meaning |\n|---|---|---|---|---|");
  for (const ParameterDoc& p : parameters) {
    print(fmt::format("| `{}` | {} | {} | {} | {} |", p.name, p.type, cell(p.fallback), p.unit,
                      cell(p.doc)));
  }
  print("");
}

void print_plain(const std::string& kind, const std::string& name) {
  const PluginDescriptor& d = *find(kind, name).descriptor;
  print(fmt::format("{} \"{}\": {}", kind, name, d.summary));
  if (d.alias_count != 0) print("  also called: " + aliases(d));
  if (const std::string only = only_form(d); !only.empty()) print("  " + only);
  for (const ParameterDoc& p : describe(d)) {
    const std::string unit = p.unit.empty() ? "" : " [" + p.unit + "]";
    const std::string fallback = p.fallback.empty() ? "" : " (" + p.fallback + ")";
    print(fmt::format("  {} {}{}{}: {}", p.type, p.name, fallback, unit, p.doc));
  }
}

void print_kind(const std::string& kind, bool markdown) {
  if (markdown) print("## " + kind + "\n");
  for (const std::string& name : Registry::instance().names(kind)) {
    if (markdown) {
      print_markdown(kind, name);
    } else {
      print(fmt::format("{:<12} {:<16} {}", kind, name, find(kind, name).descriptor->summary));
    }
  }
}

std::vector<std::string> plugin_kinds() {
  std::vector<std::string> kinds = Registry::instance().kinds();
  std::erase(kinds, "module");  // libraries, not plugins that scenes name
  return kinds;
}

void check_kind(const std::string& kind) {
  const std::vector<std::string> kinds = plugin_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  std::string known;
  for (const std::string& k : kinds) known += (known.empty() ? "" : ", ") + k;
  throw Error("there is no kind \"" + kind + "\" of plugin; there are: " + known);
}

}  // namespace

int run_plugins(const Arguments& arguments) {
  CLI::App app("Prints the reference of the plugins.", "pssmlt plugins");
  std::string kind, name;
  bool markdown = false;
  app.add_option("kind", kind, "kind of plugin: integrator, sampler, ...");
  app.add_option("name", name, "name of the plugin");
  app.add_flag("--markdown", markdown, "as Markdown, with all parameters");
  if (!parse_arguments(app, arguments)) return 0;
  if (!kind.empty()) check_kind(kind);
  if (!name.empty()) {
    markdown ? print_markdown(kind, name) : print_plain(kind, name);
    return 0;
  }
  if (markdown && kind.empty()) {
    print("# Plugins\n\nMade from the code by `pssmlt plugins --markdown`.\n");
  }
  for (const std::string& k : kind.empty() ? plugin_kinds() : std::vector{kind}) {
    print_kind(k, markdown);
  }
  return 0;
}

}  // namespace pssmlt
