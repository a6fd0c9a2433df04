// A Markov chain that changes only one stream keeps the other end's subpath: the splats are, bit by
// bit, those of an evaluation from scratch, and no number of a kept stream is asked for again.
#include <gtest/gtest.h>

#include "core/sampling/primary_sample_owner.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

// Numbers as a function of what each stream was last changed by.
class EpochSource final : public NumberSource {
 public:
  std::array<uint32_t, stream_count> epoch{};
  unsigned asked = 0;  // streams, as bits
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    const auto s = static_cast<uint32_t>(stream);
    asked |= 1u << s;
    block = philox(11, {epoch[s], index, s, static_cast<uint32_t>(RandomUse::test)});
  }
};

void expect_equal(const Splats& a, const Splats& b, int step) {
  ASSERT_EQ(a.all().size(), b.all().size()) << "step " << step;
  for (size_t i = 0; i < a.all().size(); ++i) {
    const Splat &x = a.all()[i], &y = b.all()[i];
    EXPECT_EQ(x.value, y.value) << "step " << step;
    EXPECT_EQ(x.raster, y.raster) << "step " << step;
    EXPECT_EQ(x.tag.s, y.tag.s);
    EXPECT_EQ(x.tag.t, y.tag.t);
  }
}

const char* const scene = R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 1 -3  0 1 0  0 1 0
Camera "perspective" "float fov" 60 "float lensradius" .05 "float focaldistance" 3
Integrator "bdpt" "integer maxdepth" 5
WorldBegin
LightSource "infinite" "rgb L" [ .2 .3 .4 ]
MakeNamedMaterial "a" "string type" "conductor" "float roughness" .3
MakeNamedMaterial "b" "string type" "dielectric"
MakeNamedMaterial "m" "string type" "mix" "string materials" [ "a" "b" ]
Texture "holes" "float" "checkerboard" "float tex1" 1 "float tex2" .5
Shape "trianglemesh" "point3 P" [ -2 0 -2  2 0 -2  2 0 2  -2 0 2 ] "integer indices" [ 0 1 2 0 2 3 ]
  "texture alpha" "holes"
Shape "trianglemesh" "point3 P" [ -2 0 2  2 0 2  2 3 2  -2 3 2 ] "integer indices" [ 0 1 2 0 2 3 ]
AttributeBegin
  NamedMaterial "m"
  Translate 0 .8 0
  Shape "sphere" "float radius" .6
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 4 4 4 ]
  Translate 0 2.2 0
  Shape "sphere" "float radius" .4
AttributeEnd
)";

TEST(SubpathReuse, EqualsEvaluationFromScratch) {
  for (const char* integrator : {"bdpt", "light", "path", "whitted"}) {
    const BuiltScene built = build_text({scene, integrator, "independent"});
    Integrator& f = *built.layers[0].integrator;
    f.prepare(*built.scene);
    PrimarySampleOwner owner(*built.raster_map), reference(*built.raster_map);
    Workspace workspace;
    Splats splats, expected;
    splats.keep_tags(true);
    expected.keep_tags(true);
    EpochSource current;
    const auto from_scratch = [&](EpochSource source) {
      Workspace fresh;
      reference.begin(source);
      expected.clear();
      f.sample(reference.sample(), expected, fresh);
    };
    owner.begin(current);
    f.sample(owner.sample(), splats, workspace);
    RandomStream u(5, RandomUse::test);
    size_t total = 0;
    for (int step = 1; step <= 500; ++step) {
      const unsigned changed = 1 + u.bits() % 15;
      EpochSource proposed = current;
      proposed.asked = 0;
      for (size_t s = 0; s < stream_count; ++s)
        if (changed >> s & 1u) proposed.epoch[s] = static_cast<uint32_t>(step);
      owner.begin_proposal(proposed, changed);
      splats.clear();
      f.sample(owner.sample(), splats, workspace);
      // The connection stream alone may be read further by paths that got longer.
      const unsigned connection = 1u << static_cast<unsigned>(Stream::connection);
      const unsigned shared = 1u << static_cast<unsigned>(Stream::shared);
      if ((changed & shared) == 0) {
        EXPECT_EQ(proposed.asked & ~(changed | connection), 0u) << integrator << " " << step;
      }
      from_scratch(proposed);
      expect_equal(splats, expected, step);
      total += splats.all().size();
      if (u.next() < 0.5f) {
        owner.accept();
        current = proposed;
      } else {
        owner.reject();
      }
    }
    EXPECT_GT(total, 100u) << integrator;
  }
}

}  // namespace
}  // namespace pssmlt::test
