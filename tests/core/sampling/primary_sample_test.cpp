#include <gtest/gtest.h>

#include "core/sampling/primary_sample_owner.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

// Block i of stream s is filled with s * 1000 + i + the number of fills so far * 10^6.
class CountingSource final : public NumberSource {
 public:
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    ++fills;
    block.fill(static_cast<uint32_t>(stream) * 1000 + index + fills * 1000000);
  }
  uint32_t fills = 0;
};

constexpr unsigned bit(Stream s) { return 1u << static_cast<unsigned>(s); }

TEST(PrimarySample, ReadsANumberOnceAndKeepsIt) {
  const RasterMap map = test::box_map(4, 4);
  PrimarySampleOwner owner(map);
  CountingSource source;
  owner.begin(source);
  PrimarySample& u = owner.sample();
  const float first = u.numbers(Stream::light, 3, 1).next();
  Numbers early = u.numbers(Stream::camera, 1);
  (void)u.numbers(Stream::camera, 500);  // grows the buffer
  EXPECT_EQ(early.next(), u.numbers(Stream::camera, 1).next());
  EXPECT_EQ(u.numbers(Stream::light, 3, 1).next(), first);
  EXPECT_EQ(source.fills, 3u);
  EXPECT_EQ(u.held(Stream::light).end(), 8u);
  owner.begin(source);
  EXPECT_EQ(u.held(Stream::light).end(), 0u);
  EXPECT_NE(u.numbers(Stream::light, 3, 1).next(), -1.f);
  EXPECT_EQ(source.fills, 4u);
}

TEST(PrimarySample, RasterCountsAsReadAndGivesThePixel) {
  const RasterMap map = test::box_map(8, 2);
  PrimarySampleOwner owner(map);
  CountingSource source;
  owner.begin(source);
  EXPECT_FALSE(owner.sample().raster_known());
  EXPECT_EQ(owner.credit().pixel, -1);
  owner.restore(Stream::camera).add(0) = {0x60000000u, 0xC0000000u, 0, 0};  // 3/8, 3/4
  const dvec2 raster = owner.sample().raster();
  EXPECT_EQ(raster, dvec2(3.0, 1.5));
  EXPECT_EQ(owner.credit().pixel, 8 + 3);
  EXPECT_EQ(owner.credit().weight, 1.f);
  EXPECT_EQ(source.fills, 0u);
  owner.begin(source);
  owner.set_pixel(5);
  owner.restore(Stream::camera).add(0) = {0x60000000u, 0xC0000000u, 0, 0};
  EXPECT_EQ(owner.sample().raster(), dvec2(5.375, 0.75));
  EXPECT_EQ(owner.credit().pixel, 5);
}

TEST(PrimarySampleOwner, ProposalsShareUnchangedStreams) {
  const RasterMap map = test::box_map(4, 4);
  PrimarySampleOwner owner(map);
  CountingSource source;
  owner.begin(source);
  PrimarySample& u = owner.sample();
  const float camera = u.numbers(Stream::camera, 1).next();
  const float light = u.numbers(Stream::light, 1).next();
  const dvec2 raster = u.raster();
  const StreamVersion camera_before = u.version(Stream::camera);
  const StreamVersion light_before = u.version(Stream::light);
  EXPECT_EQ(light_before.now, light_before.keep);

  owner.begin_proposal(source, bit(Stream::light));
  EXPECT_EQ(u.version(Stream::camera).now, camera_before.now);
  EXPECT_NE(u.version(Stream::light).now, light_before.now);
  EXPECT_EQ(u.version(Stream::light).keep, light_before.now);
  EXPECT_TRUE(u.raster_known());
  EXPECT_EQ(u.numbers(Stream::camera, 1).next(), camera);
  EXPECT_NE(u.numbers(Stream::light, 1).next(), light);
  const float added = u.numbers(Stream::camera, 2).next();  // not read by the current state
  owner.reject();
  EXPECT_EQ(u.version(Stream::light).now, light_before.now);
  EXPECT_EQ(u.numbers(Stream::light, 1).next(), light);
  EXPECT_EQ(u.numbers(Stream::camera, 2).next(), added);  // a version's numbers never change
  EXPECT_EQ(u.raster(), raster);

  owner.begin_proposal(source, bit(Stream::light));
  const float new_light = u.numbers(Stream::light, 1).next();
  const uint64_t new_version = u.version(Stream::light).now;
  owner.accept();
  EXPECT_EQ(u.numbers(Stream::light, 1).next(), new_light);
  EXPECT_EQ(u.version(Stream::light).now, new_version);
  EXPECT_EQ(u.version(Stream::light).keep, new_version);
}

TEST(PrimarySampleOwner, AChangedSharedStreamChangesAllVersions) {
  const RasterMap map = test::box_map(4, 4);
  PrimarySampleOwner owner(map);
  CountingSource source;
  owner.begin(source);
  PrimarySample& u = owner.sample();
  const float camera = u.numbers(Stream::camera, 1).next();
  const uint64_t before = u.version(Stream::camera).now;
  owner.begin_proposal(source, bit(Stream::shared));
  EXPECT_NE(u.version(Stream::camera).now, before);
  EXPECT_EQ(u.version(Stream::camera).keep, before);
  EXPECT_EQ(u.numbers(Stream::camera, 1).next(), camera);
  owner.reject();
  EXPECT_EQ(u.version(Stream::camera).now, before);
}

TEST(PrimarySampleOwner, ARejectedFilmStepGivesTheRasterBack) {
  const RasterMap map = test::box_map(64, 64);
  PrimarySampleOwner owner(map);
  CountingSource source;
  source.fills = 1000;
  owner.begin(source);
  const dvec2 raster = owner.sample().raster();
  const PixelCredit credit = owner.credit();
  owner.begin_proposal(source, bit(Stream::camera));
  EXPECT_FALSE(owner.sample().raster_known());
  EXPECT_EQ(owner.credit().pixel, -1);
  EXPECT_NE(owner.sample().raster(), raster);
  owner.reject();
  EXPECT_EQ(owner.sample().raster(), raster);
  EXPECT_EQ(owner.credit().pixel, credit.pixel);
}

}  // namespace
}  // namespace pssmlt
