#include "core/net/socket.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <string>
#include <thread>

#include "core/base/error.h"

namespace pssmlt {
namespace {

TEST(HostPortTest, WhatPeopleType) {
  const auto parse = [](const std::string& text) {
    return parse_host_port(text, 14158, "--display");
  };
  EXPECT_EQ(parse("localhost").host, "localhost");
  EXPECT_EQ(parse("localhost").port, 14158);
  EXPECT_EQ(parse("127.0.0.1:80").host, "127.0.0.1");
  EXPECT_EQ(parse("127.0.0.1:80").port, 80);
  EXPECT_EQ(parse("[::1]:65535").host, "::1");
  EXPECT_EQ(parse("[::1]:65535").port, 65535);
  EXPECT_EQ(parse("[::1]").port, 14158);
  for (const char* text : {"", ":80", "a:", "a:0", "a:65536", "a:-1", "a:8x", "a:8:9", "::1",
                           "[::1", "[]", "[::1]x", "[::1]80", "[::1]:"}) {
    EXPECT_THROW(parse(text), Error) << text;
  }
}

class Pair : public testing::Test {
 protected:
  void SetUp() override {
    int both[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, both), 0);
    a_.reset(both[0]);
    b_.reset(both[1]);
  }
  Descriptor a_, b_;
  WakeUp wake_;
};

TEST_F(Pair, SendsAllOrSaysSo) {
  const std::string text(size_t{4} << 20, 't');
  std::string got;
  std::thread reader([&] {
    char buffer[4096];
    for (ssize_t n; (n = recv(b_.get(), buffer, sizeof buffer, 0)) > 0;) {
      got.append(buffer, static_cast<size_t>(n));
    }
  });
  EXPECT_TRUE(send_all(a_.get(), text.data(), text.size(), wake_, 20.0, deadline_after(20.0)));
  a_.reset();
  reader.join();
  EXPECT_EQ(got, text);
}

TEST_F(Pair, GivesUpOnWhoeverTakesNothing) {
  const std::string text(size_t{4} << 20, 't');
  EXPECT_FALSE(send_all(a_.get(), text.data(), text.size(), wake_, 0.05, deadline_after(20.0)));
  EXPECT_FALSE(send_all(a_.get(), text.data(), text.size(), wake_, 20.0, deadline_after(0.05)));
  b_.reset();
  EXPECT_FALSE(send_all(a_.get(), text.data(), text.size(), wake_, 20.0, deadline_after(20.0)));
}

TEST_F(Pair, TheBellEndsAllWaits) {
  std::thread waiting([&] {
    EXPECT_FALSE(wait_for_socket(a_.get(), POLLIN, wake_, deadline_after(1000.0)));
    EXPECT_FALSE(wait_for_socket(a_.get(), POLLIN, wake_, NetClock::time_point::max()));
  });
  wake_.ring();
  waiting.join();
}

TEST_F(Pair, NobodyThere) {
  std::string why;
  // Port 1 of loopback: nothing listens there.
  EXPECT_FALSE(connect_to({"127.0.0.1", 1}, wake_, 5.0, why).valid());
  EXPECT_FALSE(why.empty());
}

}  // namespace
}  // namespace pssmlt
