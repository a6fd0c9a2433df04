#include "core/color/color_warnings.h"

#include <mutex>
#include <utility>

namespace pssmlt {
namespace {

constexpr size_t kept = 100;

struct Collected {
  std::mutex mutex;
  std::vector<std::string> messages;
  size_t left_out = 0;
};

Collected& collected() {
  static Collected all;
  return all;
}

}  // namespace

void add_color_warning(std::string message) {
  Collected& all = collected();
  const std::scoped_lock lock(all.mutex);
  if (all.messages.size() < kept)
    all.messages.push_back(std::move(message));
  else
    ++all.left_out;
}

std::vector<std::string> take_color_warnings() {
  Collected& all = collected();
  const std::scoped_lock lock(all.mutex);
  std::vector<std::string> result = std::exchange(all.messages, {});
  const size_t left_out = std::exchange(all.left_out, 0);
  if (left_out > 0) result.push_back("... and " + std::to_string(left_out) + " more colours");
  return result;
}

}  // namespace pssmlt
