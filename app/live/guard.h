// Which requests a server on this machine may answer. A page of any other site can make the
// browser send requests to loopback; what it cannot do is choose Host, Origin, or know the token.
#pragma once

#include <optional>
#include <string>

#include "core/net/http_server.h"

namespace pssmlt {

// 127.0.0.0/8 and ::1, numeric.
bool is_loopback(const std::string& address);
// "localhost" as a number, other numeric addresses as they are. Throws Error for names.
std::string numeric_address(const std::string& address);

// The value of a header that is there exactly once.
std::optional<std::string> only_header(const HttpRequest& request, const std::string& name);

HttpReply plain_reply(int status, const std::string& text);

class Guard {
 public:
  // Answers for `address` and `port`. On loopback Host has to name loopback; elsewhere a numeric
  // address or this machine's name, since both cannot be pointed here by somebody else's DNS.
  Guard(std::string address, int port);
  // A request must have one Host that is ours; Origin, where there is one, must be the same place;
  // requests without body only. nullopt: go on.
  std::optional<HttpReply> refuse(const HttpRequest& request) const;
  // For requests that change something: also needs Origin and this token.
  std::optional<HttpReply> refuse_change(const HttpRequest& request) const;
  const std::string& token() const { return token_; }
  static constexpr const char* token_header = "pssmlt-token";

 private:
  bool is_ours(const std::string& host) const;
  std::string address_;
  int port_;
  std::string token_;  // random, 128 bits
};

}  // namespace pssmlt
