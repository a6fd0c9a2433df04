// Group 11: what happens when plugins, files, disks and memory fail.
#include "app/stress/catalogue.h"
#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

constexpr const char* share = "1e-4";  // of a faulty material's directions

// Paint under a point light, at 10^-4 of whose directions something is wrong: those samples are
// dropped, all others are what they would be.
Case faulty_material() {
  Case c{.group = 11,
         .name = "faulty-material",
         .about = "a material whose value is wrong at 10^-4 of its directions: dropped and counted",
         .classes = "PDE",
         .max_depth = 1,
         .least_samples = 512};
  // 10^38 is too large, or infinite once it is multiplied.
  const std::pair<std::string, std::vector<std::string>> faults[] = {
      {"nan", {"not a number"}},
      {"infinite", {"infinite"}},
      {"negative", {"negative"}},
      {"huge", {"too large", "infinite"}}};
  for (const auto& of_fault : faults) {
    const auto scene = [fault = of_fault.first] {
      return plane_view(32, 1.0, 1.0) + R"(
LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ 0 0 1.5 ]
Material "stress_fault" "string fault" ")" +
             fault + "\" \"float probability\" " + share + "\nShape \"disk\" \"float radius\" 2\n";
    };
    c.points.push_back({.value = of_fault.first,
                        .scene = scene,
                        .oracle = Means{lit_quarters(1.0), 2e-3},
                        .drops = of_fault.second,
                        .culprit = "material \"stress_fault\""});
  }
  c.polite = [] {
    return plane_view(32, 1.0, 1.0) + R"(
LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ 0 0 1.5 ]
Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]
Shape "disk" "float radius" 2)";
  };
  return c;
}

Point process_point(const std::string& value, Outcome (*run)(const ProbeContext&)) {
  return {value, {}, Probe{run}};
}

}  // namespace

void add_fault_cases(Cases& cases) {
  cases.push_back(faulty_material());
  Case throws{.group = 11,
              .name = "throwing-integrator",
              .about = "an integrator that throws at 10^-3 of its samples: dropped and counted",
              .over = Over::samplers};
  throws.points.push_back(process_point("1e-3", throwing_integrator));
  cases.push_back(std::move(throws));
  Case machine{.group = 11,
               .name = "failing-machine",
               .about = "what fails around the program: a message and an exit code, no loss",
               .over = Over::once};
  machine.points = {process_point("memory", memory_exhausted), process_point("disk", disk_full),
                    process_point("checkpoint", checkpoint_on_full_disk),
                    process_point("texture", texture_vanishes),
                    process_point("prepare", integrator_throws_early)};
  cases.push_back(std::move(machine));
}

}  // namespace pssmlt::stress
