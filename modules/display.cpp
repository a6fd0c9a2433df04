// Display transforms through OpenColorIO: from linear Rec.709 to a view of a display. $OCIO names
// the configuration; without it there is one built here from the transforms of the library itself.
#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/log.h"
#include "core/image/image_file.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {
namespace ocio = OCIO_NAMESPACE;

constexpr const char* linear_name = "Linear Rec.709 (sRGB)";

ocio::BuiltinTransformRcPtr builtin(const char* style, bool inverse = false) {
  const auto transform = ocio::BuiltinTransform::Create();
  transform->setStyle(style);
  transform->setDirection(inverse ? ocio::TRANSFORM_DIR_INVERSE : ocio::TRANSFORM_DIR_FORWARD);
  return transform;
}

// A space of scene-referred values; `to_aces` may be null for the reference itself.
ocio::ColorSpaceRcPtr scene_space(const char* name, const ocio::ConstTransformRcPtr& to_aces) {
  const auto space = ocio::ColorSpace::Create(ocio::REFERENCE_SPACE_SCENE);
  space->setName(name);
  space->setEncoding("scene-linear");
  if (to_aces) space->setTransform(to_aces, ocio::COLORSPACE_DIR_TO_REFERENCE);
  return space;
}

void add_spaces(const ocio::ConfigRcPtr& config) {
  config->addColorSpace(scene_space("ACES2065-1", nullptr));
  config->addColorSpace(scene_space("ACEScg", builtin("ACEScg_to_ACES2065-1")));
  const auto from_rec709 = ocio::GroupTransform::Create();
  from_rec709->appendTransform(builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", true));
  from_rec709->appendTransform(builtin("ACEScg_to_ACES2065-1"));
  config->addColorSpace(scene_space(linear_name, from_rec709));
  const auto display = ocio::ColorSpace::Create(ocio::REFERENCE_SPACE_DISPLAY);
  display->setName("sRGB - Display");
  display->setTransform(builtin("DISPLAY - CIE-XYZ-D65_to_sRGB"),
                        ocio::COLORSPACE_DIR_FROM_REFERENCE);
  config->addColorSpace(display);
}

void add_view(const ocio::ConfigRcPtr& config, const char* name, const char* style) {
  const auto view = ocio::ViewTransform::Create(ocio::REFERENCE_SPACE_SCENE);
  view->setName(name);
  view->setTransform(builtin(style), ocio::VIEWTRANSFORM_DIR_FROM_REFERENCE);
  config->addViewTransform(view);
  config->addDisplayView("sRGB", name, name, "sRGB - Display", "", "", "");
}

ocio::ConstConfigRcPtr own_config() {
  const ocio::ConfigRcPtr config = ocio::Config::Create();
  config->setVersion(2, 1);
  add_spaces(config);
  // The library asks for roles by name; it refuses a configuration without a default.
  config->setRole(ocio::ROLE_SCENE_LINEAR, linear_name);
  config->setRole(ocio::ROLE_DEFAULT, linear_name);
  config->setRole(ocio::ROLE_INTERCHANGE_SCENE, "ACES2065-1");
  add_view(config, "sRGB", "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
  add_view(config, "ACES 1.0 SDR", "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0");
  config->validate();
  return config;
}

ocio::ConstConfigRcPtr load_config() {
  const char* const file = std::getenv("OCIO");
  if (!file || !*file) return own_config();
  try {
    return ocio::Config::CreateFromFile(file);
  } catch (const ocio::Exception& e) {
    throw Error(std::string("OpenColorIO configuration $OCIO: ") + e.what());
  }
}

// The configuration's space of linear Rec.709 by the names that are in use for it.
std::string linear_rec709(const ocio::ConstConfigRcPtr& config) {
  for (const char* name :
       {linear_name, "lin_rec709", "lin_rec709_srgb", "lin_srgb", "Utility - Linear - sRGB",
        "Utility - Linear - Rec.709", "Linear Rec.709", "Linear BT.709"}) {
    if (config->getColorSpace(name)) return name;
  }
  log_warning(
      "the OpenColorIO configuration has no linear Rec.709 that is known by name; its "
      "role scene_linear is used");
  return ocio::ROLE_SCENE_LINEAR;
}

std::vector<std::string> views(const ocio::ConstConfigRcPtr& config, const char* display) {
  std::vector<std::string> names;
  for (int i = 0; i < config->getNumViews(display); ++i)
    names.emplace_back(config->getView(display, i));
  return names;
}

std::string chosen_view(const ocio::ConstConfigRcPtr& config, const char* display,
                        const std::string& view) {
  if (view.empty()) return config->getDefaultView(display);
  const std::vector<std::string> known = views(config, display);
  if (std::ranges::find(known, view) != known.end()) return view;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "'" : ", '") + name + "'";
  throw Error("unknown view '" + view + "': display '" + display + "' has " + list);
}

void show(std::vector<float>& rgb, int width, int height, const std::string& view) {
  const ocio::ConstConfigRcPtr config = load_config();
  const char* const display = config->getDefaultDisplay();
  const auto transform = ocio::DisplayViewTransform::Create();
  transform->setSrc(linear_rec709(config).c_str());
  transform->setDisplay(display);
  transform->setView(chosen_view(config, display, view).c_str());
  const auto processor = config->getProcessor(transform)->getDefaultCPUProcessor();
  ocio::PackedImageDesc pixels(rgb.data(), width, height, 3);
  processor->apply(pixels);
}

}  // namespace
}  // namespace pssmlt

PSSMLT_EXPORT void pssmlt_display(std::vector<float>& rgb, int width, int height,
                                  const std::string& view) {
  try {
    pssmlt::show(rgb, width, height, view);
  } catch (const OCIO_NAMESPACE::Exception& e) {
    throw pssmlt::Error(std::string("OpenColorIO: ") + e.what());
  }
}

static_assert(std::is_same_v<decltype(pssmlt_display), pssmlt::DisplayFunction>);
