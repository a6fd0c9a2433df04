#include "core/scene/integrator_choice.h"

#include <algorithm>

#include "core/path/path_expression.h"
#include "core/path/visible_classes.h"
#include "core/scene/scene.h"

namespace pssmlt {
namespace {

constexpr int longest = 5;  // classes that are counted [scattering vertices]

int classes_seen(const Integrator& integrator) {
  const PathExpression seen(integrator.sees());
  return static_cast<int>(std::ranges::count_if(
      all_path_classes(longest), [&](const std::string& path) { return seen.matches(path); }));
}

// Does `one` find everything that `other` finds?
bool covers(const Integrator& one, const Integrator& other, const SceneFeatures& features) {
  const PathLimits& limits = one.limits();
  const std::string asked = both_expressions(other.sees(), limits.paths.text());
  return !unseen_class(one.sees(), asked, features, limits.max_bounces);
}

}  // namespace

// Leaves only those that are good, if any is.
template <typename Good>
void IntegratorChoice::keep_if_any(const Good& good) {
  const auto is_good = [&](const Named& one) { return good(*one.integrator); };
  if (std::ranges::none_of(all_, is_good)) return;
  std::erase_if(all_, [&](const Named& one) { return !is_good(one); });
}

void IntegratorChoice::prepare(const Scene& scene) {
  for (const Named& one : all_) one.integrator->prepare(scene);
  keep_if_any([](const Integrator& one) { return one.fixed(); });
  keep_if_any([](const Integrator& one) { return !one.is_for_chains(); });
  std::ranges::stable_sort(all_, std::ranges::greater(),
                           [](const Named& one) { return classes_seen(*one.integrator); });
  const std::vector<Named> some = all_;
  std::erase_if(all_, [&](const Named& one) {
    return std::ranges::any_of(some, [&](const Named& other) {
      return !covers(*one.integrator, *other.integrator, scene.features());
    });
  });
  if (all_.empty()) all_ = {some.front()};
  choose(0);
}

// A workspace serves one integrator.
void IntegratorChoice::sample(PrimarySample& u, Splats& out, Workspace& workspace) const {
  auto& own = workspace.scratch<std::vector<Workspace>>();
  if (own.size() != all_.size()) own.resize(all_.size());
  chosen().sample(u, out, own[chosen_]);
}

bool IntegratorChoice::splats_light() const {
  return std::ranges::any_of(all_, [](const Named& one) { return one.integrator->splats_light(); });
}

}  // namespace pssmlt
