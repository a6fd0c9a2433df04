#include "core/render/film.h"

#include <gtest/gtest.h>

#include "core/base/archive.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

FilmSettings settings(int width, int height) {
  FilmSettings s;
  s.size = {width, height};
  s.planes = {1, 2};
  return s;
}

Splats camera_splat(const Rgb& value, PathTag tag = {}) {
  Splats s;
  s.keep_tags(true);
  s.camera(value, tag);
  return s;
}

TEST(BlockGrid, CoversEveryPixelWithAtMost1024Blocks) {
  for (const ivec2 size : {ivec2(1, 1), ivec2(17, 3), ivec2(512, 512), ivec2(1023, 2047)}) {
    const BlockGrid grid(size);
    EXPECT_LE(grid.count(), 1024);
    EXPECT_GE(grid.edge(), 16);
    for (const int pixel : {0, size.x - 1, size.x * size.y - 1}) {
      const int x = pixel % size.x, y = pixel / size.x;
      const int across = (size.x + grid.edge() - 1) / grid.edge();
      EXPECT_EQ(grid.block(pixel), y / grid.edge() * across + x / grid.edge());
    }
  }
}

TEST(Film, MemoryComesWithTheFirstSplat) {
  Film film(settings(5, 3));
  EXPECT_EQ(film.bytes(), 0u);
  film.add(1, 1, 0, 7, dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(film.bytes(), 15u * 6u * sizeof(uint64_t));
  EXPECT_EQ(film.value(1, 1, 0, 7), dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(film.value(0, 0, 0, 7), dvec3(0.0));
  EXPECT_FALSE(film.used(1, 1, 1));
}

TEST(Film, SinkAddsCameraAndLightSplats) {
  Film film(settings(7, 5));
  BlockSums blocks = film.make_block_sums();
  const RasterMap map = test::box_map(7, 5);
  UnitSink sink(film, blocks, map, {1, 9, 0, 0, infinity, 0.5});
  Splats splats = camera_splat(Rgb(1.f, 0.5f, 0.25f));
  splats.light(dvec2(6.5, 4.5), Rgb(2.f), {});
  splats.light(dvec2(-3.0, 1.0), Rgb(100.f), {});  // outside
  for (int i = 0; i < 3; ++i) sink.add(1, splats, {8, 2.f}, 3.0, 5);
  sink.flush();
  film.end_round({&blocks});
  // The group is odd: half 1. Factor 0.5, weight 3, credit 2.
  EXPECT_EQ(film.value(1, 1, 1, 8), 9.0 * dvec3(1.0, 0.5, 0.25));
  EXPECT_EQ(film.value(1, 1, 1, 34), 4.5 * dvec3(2.0));
  EXPECT_FALSE(film.used(1, 1, 0));
  const double camera = 9.0 * (0.2126 + 0.5 * 0.7152 + 0.25 * 0.0722);
  EXPECT_NEAR(film.block_sum(1, 1, 5, 0), camera + 9.0, 1e-12);
  EXPECT_EQ(film.block_sum(1, 1, 4, 0), 0.0);
}

TEST(Film, ManyPixelsOfOneUnitAllArrive) {
  Film film(settings(40, 30));
  BlockSums blocks = film.make_block_sums();
  const RasterMap map = test::box_map(40, 30);
  UnitSink sink(film, blocks, map, {});
  const Splats splats = camera_splat(Rgb(1.f));
  for (int i = 0; i < 5 * 1200; ++i) sink.add(0, splats, {i * 7 % 1200, 1.f}, 1.0, i % 2);
  sink.flush();
  for (int p = 0; p < 1200; ++p) {
    EXPECT_EQ(film.value(0, 0, 0, p) + film.value(0, 0, 1, p), dvec3(5.0)) << p;
  }
}

TEST(Film, PixelsOutsideAreDropped) {
  Film film(settings(1, 1));
  BlockSums blocks = film.make_block_sums();
  const RasterMap map = test::box_map(1, 1);
  UnitSink sink(film, blocks, map, {});
  sink.add(0, camera_splat(Rgb(1.f)), {-1, 1.f}, 1.0, 0);
  sink.flush();
  EXPECT_EQ(film.bytes(), 0u);
}

TEST(Film, ClampHoldsForTheWholeSample) {
  Film film(settings(2, 2));
  BlockSums blocks = film.make_block_sums();
  const RasterMap map = test::box_map(2, 2);
  UnitSink sink(film, blocks, map, {0, 0, 0, 0, 2.f, 1.0});
  Splats splats = camera_splat(Rgb(3.f, 1.f, 0.f));
  splats.camera(Rgb(1.f, 1.f, 0.f), {1, 0, 0});  // in all (4, 2, 0): a factor of a half
  splats.light(dvec2(0.5, 0.5), Rgb(0.f, 8.f, 4.f), {});
  sink.add(0, splats, {3, 1.f}, 1.0, 0);
  sink.flush();
  EXPECT_EQ(film.value(0, 0, 0, 3), dvec3(2.0, 1.0, 0.0));
  EXPECT_EQ(film.value(0, 0, 0, 0), dvec3(0.0, 2.0, 1.0));
}

TEST(Film, SplitsByLengthAndStrategy) {
  FilmSettings s = settings(2, 2);
  s.split = {true, true};
  Film film(s);
  BlockSums blocks = film.make_block_sums();
  const RasterMap map = test::box_map(2, 2);
  UnitSink sink(film, blocks, map, {});
  Splats splats = camera_splat(Rgb(1.f), {2, 1, 3});
  splats.camera(Rgb(4.f), {500, 100, 200});
  sink.add(0, splats, {1, 1.f}, 1.0, 0);
  sink.flush();
  EXPECT_EQ(film.split_indices(SplitKind::length), (std::vector<int>{2, 63}));
  EXPECT_EQ(film.split_indices(SplitKind::strategy), (std::vector<int>{67, 64 * 64 - 1}));
  EXPECT_EQ(film.split_value(SplitKind::length, 2, 0, 0, 1), dvec3(1.0));
  EXPECT_EQ(film.split_value(SplitKind::strategy, 67, 0, 0, 1), dvec3(1.0));
  EXPECT_EQ(film.value(0, 0, 0, 1), dvec3(5.0));
}

TEST(Film, SavesAndLoads) {
  Film film(settings(9, 4));
  BlockSums blocks = film.make_block_sums();
  const RasterMap map = test::box_map(9, 4);
  UnitSink sink(film, blocks, map, {});
  for (int i = 0; i < 100; ++i) {
    sink.add(0, camera_splat(Rgb(0.1f * static_cast<float>(i))), {i % 36, 1.f}, 1.0, i % 32);
  }
  sink.flush();
  film.end_round({&blocks});
  Archive archive;
  film.save(archive);
  Film copy(settings(9, 4));
  Archive stored(archive.bytes());
  copy.load(stored);
  for (int p = 0; p < 36; ++p) {
    for (int half = 0; half < 2; ++half) {
      EXPECT_EQ(copy.value(0, 0, half, p), film.value(0, 0, half, p));
    }
  }
  for (int g = 0; g < group_count; ++g) {
    EXPECT_EQ(copy.block_sum(0, 0, g, 0), film.block_sum(0, 0, g, 0));
  }
  Film other(settings(4, 9));
  Archive again(archive.bytes());
  EXPECT_THROW(other.load(again), Error);
}

}  // namespace
}  // namespace pssmlt
