#include "app/live/guard.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <random>

#include "core/base/error.h"

namespace pssmlt {
namespace {

bool is_ipv4(const std::string& text) {
  in_addr parsed{};
  return inet_pton(AF_INET, text.c_str(), &parsed) == 1;
}

bool is_ipv6(const std::string& text) {
  in6_addr parsed{};
  return inet_pton(AF_INET6, text.c_str(), &parsed) == 1;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// What stands before the port in a Host, without the brackets of IPv6; "" if it is malformed.
std::string host_name(const std::string& host, int port) {
  std::string name = lower(host);
  const std::string ending = ":" + std::to_string(port);
  if (name.ends_with(ending)) {
    name.resize(name.size() - ending.size());
  } else if (port != 80) {
    return "";
  }
  const bool brackets = name.starts_with('[') && name.ends_with(']');
  if (brackets) name = name.substr(1, name.size() - 2);
  return brackets == is_ipv6(name) ? name : "";
}

std::string machine_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "";
  return lower(name.data());
}

// Takes the same time wherever the texts differ.
bool equal(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  int difference = 0;
  for (size_t i = 0; i < a.size(); ++i) difference |= a[i] ^ b[i];
  return difference == 0;
}

}  // namespace

bool is_loopback(const std::string& address) {
  return (is_ipv4(address) && address.starts_with("127.")) || address == "::1";
}

std::string numeric_address(const std::string& address) {
  if (address == "localhost") return "127.0.0.1";
  if (is_ipv4(address) || is_ipv6(address)) return address;
  throw Error("\"" + address + "\" is not a numeric address like 127.0.0.1 or ::1");
}

std::optional<std::string> only_header(const HttpRequest& request, const std::string& name) {
  std::optional<std::string> found;
  for (const auto& [key, value] : request.headers) {
    if (key != name) continue;
    if (found) return std::nullopt;
    found = value;
  }
  return found;
}

HttpReply plain_reply(int status, const std::string& text) {
  HttpReply reply;
  reply.status = status;
  reply.body = std::make_shared<const std::string>(text + "\n");
  return reply;
}

Guard::Guard(std::string address, int port) : address_(std::move(address)), port_(port) {
  std::random_device random;
  for (int i = 0; i < 4; ++i) token_ += fmt::format("{:08x}", random());
}

bool Guard::is_ours(const std::string& host) const {
  const std::string name = host_name(host, port_);
  if (name == "localhost" || (!name.empty() && name == address_)) return true;
  if (is_loopback(address_)) return name == "127.0.0.1" || name == "::1";
  return is_ipv4(name) || is_ipv6(name) || (!name.empty() && name == machine_name());
}

std::optional<HttpReply> Guard::refuse(const HttpRequest& request) const {
  const auto has = [&](const char* name) {
    return std::ranges::any_of(request.headers, [&](const auto& h) { return h.first == name; });
  };
  const std::optional<std::string> host = only_header(request, "host");
  if (!host) return plain_reply(400, "a request needs one Host");
  if (!is_ours(*host)) return plain_reply(403, "this is not the host that was asked for");
  if (has("origin") && only_header(request, "origin") != "http://" + *host) {
    return plain_reply(403, "pages from elsewhere get no answers here");
  }
  if (has("transfer-encoding") ||
      (has("content-length") && only_header(request, "content-length") != "0")) {
    return plain_reply(413, "requests have no bodies here");
  }
  return std::nullopt;
}

std::optional<HttpReply> Guard::refuse_change(const HttpRequest& request) const {
  if (!only_header(request, "origin")) return plain_reply(403, "Origin is missing");
  if (!equal(only_header(request, token_header).value_or(""), token_)) {
    return plain_reply(403, "the token is missing or not this run's");
  }
  return std::nullopt;
}

}  // namespace pssmlt
