// The live server against requests as browsers send them and as nobody should.
#include "app/live/live.h"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/error.h"
#include "tests/app/live/raw_http.h"

namespace pssmlt {
namespace {

LiveSettings settings() {
  LiveSettings s;
  s.files = {{"/", "text/html", "<p>page</p>"}, {"/live.js", "text/javascript", "code"}};
  return s;
}

class Live : public testing::Test {
 protected:
  int port() const { return server_.port(); }
  std::string get(const std::string& target) const {
    return ask(port(), request(port(), "GET " + target));
  }
  std::atomic<bool> stop_{false};
  LiveServer server_{settings(), stop_};
};

TEST_F(Live, ServesItsFiles) {
  EXPECT_EQ(server_.url(), "http://127.0.0.1:" + std::to_string(port()) + "/");
  EXPECT_EQ(status_of(get("/")), 200);
  EXPECT_EQ(body_of(get("/")), "<p>page</p>");
  EXPECT_EQ(body_of(get("/live.js?x=1")), "code");
  EXPECT_EQ(status_of(get("/live.js/")), 404);
  EXPECT_EQ(status_of(get("/nosuch")), 404);
  for (const char* header : {"X-Content-Type-Options: nosniff", "Cache-Control: no-store",
                             "Content-Security-Policy: default-src 'none'",
                             "Cross-Origin-Resource-Policy: same-origin"}) {
    EXPECT_NE(get("/").find(header), std::string::npos) << header;
  }
}

TEST_F(Live, FilesComeLater) {
  EXPECT_EQ(status_of(get("/images/a.js")), 404);
  server_.publish_file({"/images/a.js", "text/javascript", "one"});
  const std::string reply = get("/images/a.js");
  EXPECT_EQ(body_of(reply), "one");
  EXPECT_NE(reply.find("Content-Type: text/javascript"), std::string::npos);
  server_.publish_file({"/images/a.js", "text/javascript", "two"});
  EXPECT_EQ(body_of(get("/images/a.js")), "two");
}

TEST_F(Live, FilesMayBeReadWhenTheyAreAskedFor) {
  std::atomic<int> read{0};
  server_.publish_file("/images/a.js", "text/javascript", [&] {
    if (++read == 3) throw Failure("gone");
    return "reading " + std::to_string(read);
  });
  EXPECT_EQ(read, 0) << "nobody has asked";
  EXPECT_EQ(body_of(get("/images/a.js")), "reading 1");
  EXPECT_EQ(body_of(get("/images/a.js?2")), "reading 2");
  const std::string gone = get("/images/a.js");
  EXPECT_EQ(status_of(gone), 500);
  EXPECT_EQ(gone.find("gone"), std::string::npos) << "reasons may name paths";
  EXPECT_EQ(body_of(get("/images/a.js")), "reading 4");
}

TEST_F(Live, HeadHasNoBody) {
  for (const char* target : {"/", "/events"}) {
    const std::string reply = ask(port(), request(port(), std::string("HEAD ") + target));
    EXPECT_EQ(status_of(reply), 200) << target;
    EXPECT_EQ(body_of(reply), "") << target;
  }
  EXPECT_FALSE(server_.watched());
}

TEST_F(Live, NothingOutsideTheTable) {
  for (const char* target :
       {"/../live.js", "/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
        "/..%2f..%2fetc/passwd", "/%252e%252e/etc/passwd", "//etc/passwd", "/./live.js",
        "/live.js%00.html", "/%6cive.js", "/image/../../etc/passwd", "/image/%2e%2e%2fstop",
        "/image/", "/image/..", "/..\\..\\etc\\passwd", "http://127.0.0.1/", "*",
        "/?/../etc/passwd/.."}) {
    const std::string reply = get(target);
    const bool page = std::string(target) == "/?/../etc/passwd/..";  // a query is no path
    EXPECT_EQ(status_of(reply), page ? 200 : 404) << target;
    EXPECT_EQ(reply.find("root:"), std::string::npos) << target;
  }
}

TEST_F(Live, OnlyItsOwnHost) {
  const std::string p = std::to_string(port());
  const auto status = [&](const std::string& headers) {
    return status_of(ask(port(), "GET / HTTP/1.1\r\n" + headers + "\r\n"));
  };
  for (const std::string& host :
       {"127.0.0.1:" + p, "localhost:" + p, "LOCALHOST:" + p, "[::1]:" + p}) {
    EXPECT_EQ(status("Host: " + host + "\r\n"), 200) << host;
  }
  for (const std::string& host :
       {"evil.example:" + p, std::string("evil.example"), std::string("127.0.0.1"),
        std::string("127.0.0.1:1"), "127.0.0.1.evil.example:" + p, "192.168.1.1:" + p,
        "localhost.:" + p, "[127.0.0.1]:" + p, "::1:" + p, "user@127.0.0.1:" + p,
        "127.0.0.1:" + p + "0", "0.0.0.0:" + p}) {
    EXPECT_EQ(status("Host: " + host + "\r\n"), 403) << host;
  }
  EXPECT_EQ(status(""), 400);
  EXPECT_EQ(status("Host: \r\n"), 400);
  EXPECT_EQ(status(host_line(port()) + host_line(port())), 400);
  EXPECT_EQ(status_of(ask(port(), "GET / HTTP/1.0\r\n\r\n")), 400);
}

TEST_F(Live, PagesFromElsewhereGetNothing) {
  for (const std::string& origin :
       {std::string("http://evil.example"), std::string("null"),
        "https://127.0.0.1:" + std::to_string(port()), std::string("http://127.0.0.1:1")}) {
    for (const char* line : {"GET /", "GET /events", "GET /image/picture", "POST /stop"}) {
      EXPECT_EQ(status_of(ask(port(), request(port(), line, "Origin: " + origin + "\r\n"))), 403)
          << line << " " << origin;
    }
  }
  EXPECT_EQ(status_of(ask(port(), request(port(), "GET /", origin_line(port())))), 200);
}

TEST_F(Live, StopsOnlyByThePagesButton) {
  const std::string token = token_of(port());
  ASSERT_EQ(token.size(), 32u);
  EXPECT_EQ(status_of(get("/stop")), 405);
  EXPECT_EQ(status_of(ask(port(), request(port(), "HEAD /stop"))), 405);
  const std::string own = origin_line(port()), with = "Pssmlt-Token: " + token + "\r\n";
  const std::vector<std::string> refused = {"",
                                            own,
                                            with,
                                            own + "Pssmlt-Token: 0123\r\n",
                                            own + "Pssmlt-Token: \r\n",
                                            own + "Pssmlt-Token: " + std::string(32, '0') + "\r\n",
                                            "Origin: http://evil.example\r\n" + with,
                                            own + own + with,
                                            own + with + with};
  for (const std::string& headers : refused) {
    EXPECT_EQ(status_of(ask(port(), request(port(), "POST /stop", headers))), 403) << headers;
  }
  EXPECT_EQ(status_of(ask(port(), request(port(), "POST /stop?" + token, own))), 403);
  EXPECT_FALSE(stop_);
  EXPECT_EQ(status_of(ask(port(), stop_request(port(), token))), 202);
  EXPECT_TRUE(stop_);
  // Pressed twice is pressed once.
  EXPECT_EQ(status_of(ask(port(), stop_request(port(), token))), 202);
}

TEST_F(Live, OtherMethodsAreRefused) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "CONNECT"}) {
    const std::string reply =
        ask(port(), request(port(), std::string(method) + " /", origin_line(port())));
    EXPECT_EQ(status_of(reply), 405) << method;
  }
}

TEST_F(Live, BodiesAreRefusedUnread) {
  for (const std::string& headers :
       {std::string("Content-Length: 1000000000\r\n"), std::string("Content-Length: -1\r\n"),
        std::string("Content-Length: 5\r\nContent-Length: 0\r\n"),
        std::string("Transfer-Encoding: chunked\r\n")}) {
    const std::string text = request(port(), "POST /stop", origin_line(port()) + headers);
    EXPECT_EQ(status_of(ask(port(), text + std::string(30000, 'x'))), 413) << headers;
  }
  // What follows a request is not another one.
  const std::string two = request(port(), "GET /") + request(port(), "GET /live.js");
  EXPECT_EQ(body_of(ask(port(), two)), "<p>page</p>");
}

TEST_F(Live, MalformedAndOversizedRequests) {
  const std::string host = host_line(port());
  std::vector<std::string> bad = {"\r\n\r\n",
                                  "GET\r\n\r\n",
                                  "GET /\r\n" + host + "\r\n",
                                  "GET / HTTP/9.9\r\n" + host + "\r\n",
                                  "BREW /pot HTTP/1.1\r\n" + host + "\r\n",
                                  "GET / / HTTP/1.1\r\n" + host + "\r\n",
                                  std::string("GET /\0/ HTTP/1.1\r\n", 18) + host + "\r\n",
                                  std::string(100, '\0') + "\r\n\r\n",
                                  "\x16\x03\x01\x02\x05\x01\r\n\r\n",
                                  "GET /" + std::string(20000, 'a') + " HTTP/1.1\r\n\r\n",
                                  std::string(100000, 'G'),
                                  "GET / HTTP/1.1\r\n" + host + "A: " + std::string(50000, 'b'),
                                  "GET / HTTP/1.1\r\nHost\r\n\r\n"};
  std::string many = "GET / HTTP/1.1\r\n" + host;
  for (int i = 0; i < 20000; ++i) many += "h" + std::to_string(i) + ": v\r\n";
  bad.push_back(many + "\r\n");
  for (const std::string& text : bad) {
    RawClient client(port());
    client.send_text(text);
    const int status = status_of(client.read_all());
    // A reset connection loses the reply, which then reads as 0.
    EXPECT_TRUE(status == 0 || (status >= 400 && status < 500)) << text.substr(0, 60) << status;
    EXPECT_FALSE(client.timed_out());
  }
  EXPECT_EQ(status_of(get("/")), 200);
}

TEST_F(Live, RangesAndEncodingsChangeNothing) {
  std::string ranges = "Range: bytes=0-";
  for (int i = 0; i < 1500; ++i) ranges += ",0-";
  const std::vector<std::string> headers = {ranges + "\r\n", "Range: bytes=2-3\r\n",
                                            "Accept-Encoding: gzip, br\r\n",
                                            "Range: bytes=" + std::string(7000, '1') + "-\r\n"};
  for (const std::string& header : headers) {
    const std::string reply = ask(port(), request(port(), "GET /live.js", header));
    const int status = status_of(reply);
    EXPECT_TRUE(status == 200 || (status >= 400 && status < 500)) << header.substr(0, 40) << status;
    if (status == 200) {
      EXPECT_EQ(body_of(reply), "code") << header.substr(0, 40);
    }
  }
  EXPECT_EQ(status_of(get("/")), 200);
}

TEST_F(Live, SeveralPagesSeeTheSame) {
  server_.publish({{"n", 1}});
  std::vector<std::unique_ptr<RawClient>> pages;
  for (int i = 0; i < 8; ++i) {
    pages.push_back(std::make_unique<RawClient>(port()));
    pages.back()->send_text(request(port(), "GET /events"));
    EXPECT_NE(pages.back()->read_until("{\"n\":1}").find("event: status"), std::string::npos);
  }
  EXPECT_TRUE(server_.watched());
  server_.publish({{"n", 2}});
  server_.publish_image("picture", std::string("pixels"));
  for (const auto& page : pages) {
    EXPECT_NE(page->read_until("\"picture\"").find("{\"n\":2}"), std::string::npos);
    EXPECT_FALSE(page->timed_out());
  }
  pages.clear();
  server_.drain(patience / 1000.0);
  EXPECT_FALSE(server_.watched());
}

TEST_F(Live, ImagesHaveVersionsAndAreEncodedOnce) {
  EXPECT_EQ(status_of(get("/image/picture")), 404);
  std::atomic<int> encoded{0};
  server_.publish_image("picture", [&] { return "first" + std::to_string(++encoded); });
  EXPECT_EQ(encoded, 0) << "nobody has asked";
  const std::string first = get("/image/picture");
  EXPECT_EQ(body_of(first), "first1");
  EXPECT_EQ(body_of(get("/image/picture?after=0")), "first1");
  const size_t at = first.find("Pssmlt-Version: ");
  ASSERT_NE(at, std::string::npos);
  const std::string version = first.substr(at + 16, first.find('\r', at) - at - 16);
  EXPECT_EQ(status_of(get("/image/picture?after=" + version)), 204);
  EXPECT_EQ(encoded, 1);
  server_.publish_image("picture", std::string("second"));
  EXPECT_EQ(body_of(get("/image/picture?after=" + version)), "second");
  EXPECT_EQ(status_of(get("/image/other")), 404);
}

TEST_F(Live, EncodingThatFailsIsAnError) {
  server_.publish_image("picture", []() -> std::string { throw Failure("no"); });
  EXPECT_EQ(status_of(get("/image/picture")), 500);
  EXPECT_EQ(status_of(get("/")), 200);
}

// Clients that are slow in every way: half a request, a request byte by byte without end, a large
// reply that nobody reads, a stream that nobody reads. Publishing goes on, others are served, and
// the server's end waits for none of them.
TEST(LiveServerTest, StalledClientsHoldNothingUp) {
  std::atomic<bool> stop{false};
  auto server = std::make_unique<LiveServer>(settings(), stop);
  const int port = server->port();
  server->publish_image("picture", std::string(size_t{32} << 20, 'x'));
  RawClient nothing(port), half(port), slow(port), greedy(port, 4096), stream(port, 4096);
  half.send_text("GET / HTTP/1.1\r\nHost: 127");
  slow.send_text("G");
  greedy.send_text(request(port, "GET /image/picture"));
  stream.send_text(request(port, "GET /events"));
  stream.read_until("hello");
  const std::string large(100000, 's');
  for (int i = 0; i < 300; ++i) server->publish({{"i", i}, {"large", large}});
  slow.send_text("E");
  EXPECT_EQ(body_of(ask(port, request(port, "GET /live.js"))), "code");
  const auto start = std::chrono::steady_clock::now();
  server.reset();
  // Far below any of the server's own timeouts (5, 10 and 60 s), far above what it needs.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
}

TEST(LiveServerTest, ConnectionsAreLimited) {
  std::atomic<bool> stop{false};
  LiveServer server(settings(), stop);
  std::vector<std::unique_ptr<RawClient>> streams;
  for (int i = 0; i < 32; ++i) {
    streams.push_back(std::make_unique<RawClient>(server.port()));
    streams.back()->send_text(request(server.port(), "GET /events"));
    streams.back()->read_until("hello");
  }
  RawClient one_more(server.port());
  EXPECT_EQ(status_of(one_more.read_all()), 503);
  streams.clear();
  server.drain(patience / 1000.0);
  // Threads end a moment after their streams.
  int status = 0;
  for (int i = 0; i < 100 && status != 200; ++i) {
    RawClient again(server.port());
    again.send_text(request(server.port(), "GET /"));
    status = status_of(again.read_all());
    if (status != 200) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(status, 200);
}

TEST(LiveServerTest, APortInUseIsAnError) {
  std::atomic<bool> stop{false};
  const LiveServer first(settings(), stop);
  LiveSettings same = settings();
  same.port = first.port();
  try {
    const LiveServer second(same, stop);
    FAIL() << "two servers at one port";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(first.port())), std::string::npos)
        << error.what();
  }
}

TEST(LiveServerTest, OtherMachinesOnlyWhenAsked) {
  std::atomic<bool> stop{false};
  for (const char* address : {"0.0.0.0", "::", "192.168.0.1", "128.0.0.1", "example.org",
                              "127.0.0.1.example.org", "", "::ffff:127.0.0.1"}) {
    LiveSettings s = settings();
    s.address = address;
    EXPECT_THROW(LiveServer(s, stop), Error) << address;
  }
  LiveSettings s = settings();
  s.address = "0.0.0.0";
  s.allow_public = true;
  const LiveServer server(s, stop);
  const auto status = [&](const std::string& host) {
    const std::string text =
        "GET / HTTP/1.1\r\nHost: " + host + ":" + std::to_string(server.port());
    return status_of(ask(server.port(), text + "\r\n\r\n"));
  };
  EXPECT_EQ(status("192.168.0.1"), 200);
  EXPECT_EQ(status("127.0.0.1"), 200);
  EXPECT_EQ(status("evil.example"), 403);
}

}  // namespace
}  // namespace pssmlt
