// Exposure, sensors and white balance of the film.
#include "core/scene/film_sensor.h"

#include <gtest/gtest.h>

#include "core/color/camera_sensors.h"
#include "core/color/color_space.h"
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

// Each picture is the camera's matrix times the observer's; exposure is the same factor for both.
TEST(FilmSensor, CamerasAreTheirMatrices) {
  const std::string canon = "\"string sensor\" \"canon_eos_100d\" ";
  const glm::dmat3 matrix = camera_sensor("canon_eos_100d").value().matrix;
  const BuiltScene scene = build_text(wall(canon + "\"float iso\" 150"));
  int lines = 0;
  for (const std::string& line : scene.log)
    lines += line.find("sensor \"canon_eos_100d\" is a matrix fitted") != std::string::npos;
  EXPECT_EQ(lines, 1);
  EXPECT_EQ(scene.exposure, 1.5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(scene.balance[c][c], matrix[c][c], 1e-9);
  const dvec3 white = matrix * dvec3(1.0);
  const Rgb seen_white = seen(wall(canon)), brighter = seen(wall(canon + "\"float iso\" 150"));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(double(seen_white[c]), white[c], 1e-5);
    EXPECT_NEAR(brighter[c], 1.5f * seen_white[c], 1e-5f);
  }
}

// Greys are proportional to white, and a blue wall is the matrix times its colour.
TEST(FilmSensor, ColoursOfACamera) {
  const auto emitting = [](const std::string& film, const std::string& color) {
    Job job = wall(film);
    job.scene.replace(job.scene.find("[1 1 1]"), 7, color);
    return seen(job);
  };
  for (const char* name : {"canon_eos_100d", "nikon_d850", "sony_ilce_9"}) {
    const std::string film = std::string("\"string sensor\" \"") + name + "\"";
    const Rgb white = emitting(film, "[1 1 1]"), grey = emitting(film, "[.18 .18 .18]");
    const Rgb blue = emitting(film, "[.02 .06 .25]");
    const dvec3 expected = camera_sensor(name).value().matrix * dvec3(.02, .06, .25);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(grey[c], .18f * white[c], 1e-6f) << name;
      EXPECT_NEAR(double(blue[c]), expected[c], 1e-6) << name;
    }
  }
}

// The lamp's light looks as daylight of 6500 K did.
TEST(FilmSensor, WhiteBalanceOfACamera) {
  const std::string film = "\"string sensor\" \"nikon_d850\"";
  Job lamp = wall(film + " \"float whitebalance\" 3200");
  lamp.scene.replace(lamp.scene.find("\"rgb L\" [1 1 1]"), 15, "\"blackbody L\" 3200");
  const Rgb balanced = seen(lamp);
  const dvec3 daylight = rec709_from_xyz() * white_xyz(6500.0);
  const dvec3 expected = camera_sensor("nikon_d850").value().matrix * daylight;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(double(balanced[c] / balanced.y), expected[c] / expected.y, 1e-5) << c;
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
