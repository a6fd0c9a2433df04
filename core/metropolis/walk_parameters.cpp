#include "core/metropolis/walk_parameters.h"

#include <array>
#include <cmath>

#include "core/metropolis/walker.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 3> kernel_names = {"kelemen", "gaussian", "cauchy"};

double probability(Parameters& p, std::string_view name, float fallback, std::string_view doc) {
  const float value = p.number(name, fallback, "", doc);
  if (!(value >= 0.f && value <= 1.f)) {
    p.fail(name, "\"" + std::string(name) + "\" must lie in [0, 1]");
  }
  return value;
}

KernelShape shape_of(std::string_view name) {
  if (name == "gaussian") return KernelShape::gaussian;
  return name == "cauchy" ? KernelShape::cauchy : KernelShape::kelemen;
}

}  // namespace

StepMix read_step_mix(Parameters& p, float large) {
  StepMix mix;
  mix.large =
      probability(p, "largestepprobability", large,
                  large > 0.f ? "of drawing all numbers anew; 0 warns: chains then do not meet"
                              : "of drawing all numbers anew");
  mix.film = probability(p, "filmprobability", 0.3f, "of small steps: of the film position alone");
  mix.stream = probability(p, "streamprobability", 0.f,
                           "of small steps: of one stream alone (camera, light, connections)");
  mix.range = probability(p, "rangeprobability", 0.f, "of small steps: of some vertices alone");
  if (mix.film + mix.stream + mix.range > 1.0 + 1e-6) {
    p.fail("\"filmprobability\", \"streamprobability\", \"rangeprobability\" exceed 1 in sum");
  }
  return mix;
}

KernelChoice read_kernels(Parameters& p) {
  // pbrt's "mlt" has a gaussian kernel and "sigma" alone: who gives sigma means that.
  const bool gaussian = p.has("sigma") && !p.has("kernel");
  KernelChoice choice;
  choice.shape = shape_of(p.choice("kernel", gaussian ? "gaussian" : "kelemen", kernel_names,
                                   "of small steps (gaussian if only sigma is given)"));
  const float sigma =
      p.number("sigma", 0.01f, "", "scale of the gaussian or cauchy kernel; kelemen's is fixed");
  const float film = p.number("filmsigma", 0.f, "picture sizes",
                              "scale of steps of the film position; 0: as all other numbers");
  if (!(sigma > 0.f && sigma <= 1.f)) p.fail("sigma", "\"sigma\" must lie in (0, 1]");
  if (!(film >= 0.f && film <= 1.f)) p.fail("filmsigma", "\"filmsigma\" must lie in [0, 1]");
  if (choice.shape == KernelShape::kelemen && p.has("sigma")) {
    p.fail("sigma", "\"sigma\" has no meaning for the kernel \"kelemen\"");
  }
  if (choice.shape != KernelShape::kelemen) choice.scale = sigma;
  choice.film_scale = film > 0.f ? film : choice.scale;
  return choice;
}

void set_kernels(WalkSettings& walk, const KernelChoice& k, const ivec2& size,
                 const StepFactors& factors) {
  const dvec2 edges(size);
  const double side = std::sqrt(edges.x * edges.y);
  for (size_t i = 0; i < step_kinds; ++i) walk.kernels[i] = Kernel(k.shape, k.scale * factors[i]);
  const double film = k.film_scale * factors[static_cast<size_t>(StepKind::film)] * side;
  walk.film_x = Kernel(k.shape, film / edges.x);
  walk.film_y = Kernel(k.shape, film / edges.y);
}

}  // namespace pssmlt
