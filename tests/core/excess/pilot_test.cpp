#include "core/excess/pilot.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using test::frame_of;

// Every cell's pixel lies in the cell, whatever the size, and all pixels of the window belong to a
// cell.
TEST(PilotLattice, PixelsLieInTheirCells) {
  for (const int stride : {1, 2, 3, 7}) {
    RasterFrame frame = frame_of(31, 17);
    frame.crop_min = {3, 2};
    const PilotLattice lattice(frame, stride);
    for (uint32_t c = 0; c < static_cast<uint32_t>(lattice.count()); ++c) {
      const ivec2 pixel = lattice.pixel(c);
      ASSERT_TRUE(pixel.x >= 0 && pixel.y >= 0 && pixel.x < 28 && pixel.y < 15);
      EXPECT_EQ(lattice.at(dvec2(pixel + frame.crop_min) + 0.5), static_cast<size_t>(c));
    }
    std::set<size_t> met;
    for (int y = 2; y < 17; ++y) {
      for (int x = 3; x < 31; ++x) met.insert(lattice.at({x + 0.5, y + 0.5}));
    }
    EXPECT_EQ(met.size(), static_cast<size_t>(lattice.count()));
  }
}

TEST(PilotLattice, OutsideIsTheNearestCell) {
  const PilotLattice lattice(frame_of(8, 8), 4);
  EXPECT_EQ(lattice.at({-50.0, -1.0}), 0u);
  EXPECT_EQ(lattice.at({1e9, 1e9}), 3u);
}

TEST(Pilot, KeepsOrderWhenPartsAreAppended) {
  const RasterFrame frame = frame_of(2, 1);
  Pilot all(frame, PilotLattice(frame, 1)), part = all;
  Splats splats;
  splats.camera(Rgb(2.f), {});
  splats.light({1.5, 0.5}, Rgb(3.f), {});
  part.add(splats, {0, 1.f}, 0, 0);
  part.add({}, {1, 1.f}, 1, 1);
  part.add_rays(5.0);
  all.append(part);
  all.append(part);
  ASSERT_EQ(all.samples(), 4u);
  EXPECT_EQ(all.finds(), 2u);
  EXPECT_EQ(all.rays(), 10.0);
  EXPECT_EQ(all.splats(1).size(), 0u);
  ASSERT_EQ(all.splats(2).size(), 2u);
  EXPECT_EQ(all.splats(2)[0].raster, vec2(0.5f, 0.5f));
  EXPECT_EQ(all.splats(2)[1].raster, vec2(1.5f, 0.5f));
  EXPECT_FLOAT_EQ(all.sample(2).camera, 2.f);
  EXPECT_EQ(all.sample(3).cell, 1u);
  EXPECT_EQ(all.sample(3).half(), 1u);
}

}  // namespace
}  // namespace pssmlt
