// Exposure and white balance of the film.
#include "core/scene/film_sensor.h"

#include <gtest/gtest.h>

#include "tests/support/render_text.h"

namespace pssmlt {
namespace {

using namespace test;

// A wall that emits (1, 1, 1) and fills the picture.
Job wall(const std::string& film, const std::string& camera = "") {
  Job job;
  job.scene = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 " + film +
              " Sampler \"independent\" Camera \"perspective\" " + camera +
              " WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1]";
  job.spp = 1;
  return job;
}
Rgb seen(const Job& job) {
  const Image image = render_text(job, 1).image;
  return {image.data[0], image.data[1], image.data[2]};
}

TEST(FilmSensor, ExposureIsTimeTimesSpeed) {
  EXPECT_EQ(seen(wall("")), Rgb(1.f));
  EXPECT_EQ(seen(wall("\"float iso\" 150")), Rgb(1.5f));
  EXPECT_EQ(seen(wall("\"float iso\" 200", "\"float shutterclose\" .25")), Rgb(.5f));
  EXPECT_EQ(seen(wall("\"float exposuretime\" .5", "\"float shutterclose\" .25")), Rgb(.5f));
  EXPECT_EQ(seen(wall("\"float imagingratio\" 3 \"float iso\" 7")), Rgb(3.f));
}

// D65 is white as it is; light bulbs make it blue.
TEST(FilmSensor, WhiteBalance) {
  const Rgb daylight = seen(wall("\"float whitebalance\" 6500"));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(daylight[c], 1.f, 2e-3f);
  const Rgb bulb = seen(wall("\"float whitebalance\" 2856"));
  EXPECT_LT(bulb.x, .8f);
  EXPECT_GT(bulb.z, 2.f);
}

TEST(FilmSensor, CamerasAreSaid) {
  const BuiltScene scene =
      build_text(wall("\"string sensor\" \"canon_eos_100d\" \"float iso\" 150"));
  int lines = 0;
  for (const std::string& line : scene.log)
    lines += line.find("canon_eos_100d") != std::string::npos;
  EXPECT_EQ(lines, 1);
  EXPECT_EQ(scene.exposure, 1.5);
  const Rgb grey = seen(wall("\"string sensor\" \"nikon_d850\""));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(grey[c], 1.f, 2e-3f);
}

TEST(FilmSensor, Errors) {
  for (const auto& [film, word] :
       {std::pair{"\"string sensor\" \"nikon_d851\"", "nikon_d850"},
        std::pair{"\"float iso\" 0", "must be positive"},
        std::pair{"\"float exposuretime\" -1", "must be positive"},
        std::pair{"\"float whitebalance\" 100", "between 1000 and 25000 K"}}) {
    try {
      build_text(wall(film));
      ADD_FAILURE() << film;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("test-scene:1:"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace pssmlt
