#include "app/live/tev.h"

#include <gtest/gtest.h>

#include <cstring>

#include "app/live/tev_packet.h"
#include "core/base/error.h"
#include "core/base/log.h"
#include "tests/app/live/fake_viewer.h"

namespace pssmlt {
namespace {

std::shared_ptr<Image> gradient(int width, int height, float first) {
  auto image = std::make_shared<Image>(width, height, 3);
  for (size_t i = 0; i < image->data.size(); ++i) {
    image->data[i] = first + 0.37f * static_cast<float>(i);
  }
  return image;
}

// Byte for byte, from the protocol's description.
TEST(TevPacket, Layout) {
  const std::string made = tev_create("a", 2, 1);
  const std::string expected("\x1d\0\0\0\4\1a\0\2\0\0\0\1\0\0\0\3\0\0\0R\0G\0B\0", 26);
  std::string with_length = expected;
  with_length[0] = static_cast<char>(expected.size());
  EXPECT_EQ(made, with_length);

  Image image(2, 2, 3);
  for (size_t i = 0; i < 12; ++i) image.data[i] = static_cast<float>(i);
  const std::string update = tev_update("a", image, {1, 0, 1, 2});
  // Head, name, channels, window, three offsets, three strides, two pixels of three floats.
  ASSERT_EQ(update.size(), 6u + 2 + 4 + 6 + 16 + 24 + 24 + 24);
  EXPECT_EQ(update.substr(4, 4), std::string("\6\0a\0", 4));
  float floats[6];
  std::memcpy(floats, update.data() + update.size() - sizeof floats, sizeof floats);
  EXPECT_EQ(std::vector<float>(floats, floats + 6), (std::vector<float>{3, 4, 5, 9, 10, 11}));
}

TEST(Tev, ThePictureArrives) {
  FakeViewer viewer;
  TevDisplay display(viewer.address(), "scene");
  // Larger than a tile in both directions, and no multiple.
  const auto image = gradient(300, 260, 1.f);
  EXPECT_TRUE(display.ready());
  display.show(image);
  display.drain(20.0);
  EXPECT_EQ(viewer.picture("scene", image->data.size()).data, image->data);
  // And another one over the same connection, into the same picture.
  const auto next = gradient(300, 260, -5.f);
  display.show(next);
  display.drain(20.0);
  EXPECT_EQ(viewer.picture("scene", 2 * image->data.size()).data, next->data);
  EXPECT_EQ(viewer.connections(), 1);
}

TEST(Tev, ComesBackAfterALostConnection) {
  FakeViewer viewer;
  TevSettings settings;
  settings.retry_seconds = 0.0;
  settings.attempts = 1000;
  TevDisplay display(viewer.address(), "scene", settings);
  const auto image = gradient(40, 30, 1.f);
  display.show(image);
  viewer.picture("scene", image->data.size());
  viewer.disconnect();
  // The first packets after the end may still seem to be sent.
  while (viewer.connections() < 2) {
    display.show(image);
    display.drain(20.0);
  }
  EXPECT_EQ(viewer.picture("scene", 2 * image->data.size()).data, image->data);
}

TEST(Tev, AMissingViewerIsOneWarningAndGivenUp) {
  TevSettings settings;
  settings.attempts = 2;
  settings.retry_seconds = 0.0;
  testing::internal::CaptureStderr();
  {
    TevDisplay display("127.0.0.1:1", "scene", settings);
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(display.ready());
      display.show(gradient(2, 2, 0.f));
      display.drain(20.0);
    }
    EXPECT_FALSE(display.ready());
    display.show(gradient(2, 2, 0.f));
    display.drain(20.0);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("127.0.0.1:1"), std::string::npos) << text;
  EXPECT_EQ(text.find("no viewer"), text.rfind("no viewer")) << text;
}

// A viewer that takes nothing: pictures replace each other, and the end does not wait.
TEST(Tev, AStalledViewerHoldsNothingUp) {
  FakeViewer viewer(false);
  const auto start = NetClock::now();
  {
    TevDisplay display(viewer.address(), "scene");
    display.show(gradient(1500, 1000, 0.f));
    ASSERT_TRUE(viewer.wait_for_connections(1));
    for (int i = 0; i < 100; ++i) display.show(gradient(10, 10, 0.f));
    EXPECT_FALSE(display.ready());
    display.drain(0.1);
  }
  // Below the 10 s after which a connection that takes nothing is given up.
  EXPECT_LT(NetClock::now() - start, std::chrono::seconds(6));
}

TEST(Tev, AddressesAreChecked) {
  EXPECT_THROW(TevDisplay("127.0.0.1:x", "scene"), Error);
  EXPECT_THROW(TevDisplay("", "scene"), Error);
}

}  // namespace
}  // namespace pssmlt
