#include "core/path/light_draw.h"

#include "core/scene/parameters.h"

namespace pssmlt {

LightPick read_light_pick(Parameters& p) {
  static constexpr std::string_view picks[] = {"bvh", "power", "uniform"};
  const std::string pick =
      p.choice("lightsampler", "bvh", picks,
               "how lights are drawn: bvh guesses, from 8 lights on, which ones matter at a point");
  return pick == "bvh" ? LightPick::bvh : pick == "power" ? LightPick::power : LightPick::uniform;
}

}  // namespace pssmlt
