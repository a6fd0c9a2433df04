#include "app/compare/reference_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/compare/session_racer.h"
#include "app/compare/text.h"
#include "core/base/log.h"
#include "core/base/random.h"
#include "core/plugin/registry.h"
#include "core/render/output.h"

namespace pssmlt::compare {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

constexpr double checkpoint_interval = 30.0;  // of render time [s]

// What checkpoints and keys belong to shall not depend on which scenes were loaded before: all
// plugins are, from here on.
void load_all_plugins() {
  Registry& registry = Registry::instance();
  for (const std::string& kind : registry.kinds()) {
    for (const std::string& name : registry.names(kind)) {
      try {
        (void)registry.find(kind, name, {});
      } catch (const Error&) {
        continue;  // one that is broken is told to those who name it
      }
    }
  }
}

// Held while a reference is made; another process waits.
class Lock {
 public:
  explicit Lock(const fs::path& file)
      : file_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    log_info("another process makes this reference: waiting for it");
    ::flock(file_, LOCK_EX);
  }
  ~Lock() {
    if (file_ >= 0) ::close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

class Maker {
 public:
  Maker(const LoadedScene& scene, const BuildOptions& base, const ReferenceRequest& request)
      : scene_(scene), base_(base), request_(request) {
    load_all_plugins();
    folder_ = reference_folder() / reference_key(scene, base, request.techniques);
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed) {
      log_warning("references are not kept: cannot make " + folder_.string() + ": " +
                  failed.message());
      folder_.clear();
    }
  }
  std::optional<Reference> make();

 private:
  std::optional<Reference> cached() const;
  std::unique_ptr<SessionRacer> racer(int technique) const;
  bool run(SessionRacer& a, SessionRacer& b) const;
  bool render(SessionRacer& a, SessionRacer& b) const;
  void keep(const Reference& reference) const;
  fs::path state(int technique) const {
    return folder_ / ("state-" + std::to_string(technique) + ".checkpoint");
  }
  Half share(int technique, SessionRacer& racer) const {
    return {request_.techniques[static_cast<size_t>(technique)].name, racer.session().result(false),
            racer.session().group_blocks()};
  }

  const LoadedScene& scene_;
  const BuildOptions& base_;
  const ReferenceRequest& request_;
  fs::path folder_;  // empty: nothing is kept
};

std::optional<Reference> Maker::cached() const {
  const fs::path about = folder_ / "reference.json", picture = folder_ / "reference.exr";
  std::error_code failed;
  if (folder_.empty() || !fs::exists(about, failed)) return std::nullopt;
  try {
    const json j = json::parse(read_file(about.string()));
    if (j.at("seconds").get<double>() < request_.seconds) return std::nullopt;
    Reference r = read_reference(picture.string(), scene_.built.raster_map->frame().crop_size());
    r.source = "made";
    r.seconds = j.at("seconds");
    r.techniques = j.at("techniques").get<std::vector<std::string>>();
    if (!j.at("mean_error").is_null()) r.mean_error = j.at("mean_error").get<double>();
    const json& a = j.at("agreement");
    const auto number = [](const json& v) { return v.is_null() ? Number() : v.get<double>(); };
    r.agreement = Agreement{.blocks = a.at("blocks"),
                            .chi_square = number(a.at("chi_square")).value_or(0.0),
                            .degrees = a.at("degrees"),
                            .p_value = number(a.at("p_value")),
                            .biased = a.at("biased"),
                            .text = a.at("text")};
    return r;
  } catch (const std::exception& error) {
    log_warning("the reference in " + folder_.string() + " is made anew: " + error.what());
    return std::nullopt;
  }
}

std::unique_ptr<SessionRacer> Maker::racer(int technique) const {
  const Technique& t = request_.techniques[static_cast<size_t>(technique)];
  RenderSettings settings;
  settings.seconds = request_.seconds;  // no budget of samples
  settings.threads = request_.threads;
  settings.seed = reference_seed(technique);
  if (!folder_.empty()) settings.checkpoint = state(technique).string();
  const auto make = [&](bool resume) {
    settings.resume = resume;
    auto made = std::make_unique<SessionRacer>(scene_.with(t, base_), settings, nullptr);
    made->prepare();
    return made;
  };
  std::error_code failed;
  if (folder_.empty() || !fs::exists(settings.checkpoint, failed)) return make(false);
  try {
    return make(true);
  } catch (const Error& error) {
    log_warning(std::string(error.what()) + ": the reference is begun anew");
    return make(false);
  }
}

// False: interrupted.
bool Maker::run(SessionRacer& a, SessionRacer& b) const {
  const auto stopped = [&] {
    return request_.stop != nullptr && request_.stop->load(std::memory_order_relaxed);
  };
  double kept = a.elapsed() + b.elapsed();
  const auto after_slice = [&] {
    const double now = a.elapsed() + b.elapsed();
    if (request_.progress) request_.progress(now);
    if (folder_.empty() || now < kept + checkpoint_interval) return;
    kept = now;
    a.session().checkpoint();
    b.session().checkpoint();
  };
  Racer* const racers[] = {&a, &b};
  if (!interleave(racers, {0.5 * request_.seconds, request_.slice}, stopped, after_slice)) {
    return false;
  }
  // Without halves there would be no floor.
  for (SessionRacer* racer : {&a, &b}) {
    while (!racer->has_picture() || racer->session().result(false).half[1].data.empty()) {
      racer->round();
      if (stopped()) return false;
    }
  }
  return true;
}

// As run(); what was rendered is kept either way.
bool Maker::render(SessionRacer& a, SessionRacer& b) const {
  const bool done = run(a, b);
  if (!folder_.empty()) {
    a.session().checkpoint();
    b.session().checkpoint();
  }
  return done;
}

void Maker::keep(const Reference& r) const {
  if (folder_.empty()) return;
  try {
    const Image layers =
        join_layers({{"", &r.image}, {"half0", &r.half[0]}, {"half1", &r.half[1]}});
    write_image((folder_ / "reference.exr").string(), layers, {}, {});
    const json about = {{"seconds", r.seconds},
                        {"techniques", r.techniques},
                        {"mean_error", to_json(r.mean_error)},
                        {"agreement", to_json(*r.agreement)},
                        {"scene", scene_.description.file}};
    write_file((folder_ / "reference.json").string(), about.dump(2) + "\n");
  } catch (const std::exception& failure) {
    log_warning(std::string("the reference is not kept: ") + failure.what());
  }
}

std::optional<Reference> Maker::make() {
  std::optional<Lock> lock;
  if (!folder_.empty()) lock.emplace(folder_ / "lock");
  if (std::optional<Reference> found = cached()) {
    found->file = (folder_ / "reference.exr").string();
    log_info(fmt::format("reference: from the cache ({:.0f} s by {})", found->seconds,
                         join(found->techniques, " and ")));
    return found;
  }
  const auto a = racer(0), b = racer(1);
  if (!render(*a, *b)) return std::nullopt;
  Reference r = combine(share(0, *a), share(1, *b));
  if (!folder_.empty()) r.file = (folder_ / "reference.exr").string();
  keep(r);
  return r;
}

}  // namespace

fs::path reference_folder() {
  fs::path cache;
  const char* const chosen = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  if (chosen != nullptr && *chosen == '/') {  // relative ones are to be ignored
    cache = chosen;
  } else if (home != nullptr && *home != '\0') {
    cache = fs::path(home) / ".cache";
  } else {
    std::error_code failed;
    cache = fs::temp_directory_path(failed);
  }
  return cache / "pssmlt" / "references";
}

std::string reference_key(const LoadedScene& scene, const BuildOptions& base,
                          const std::vector<Technique>& techniques) {
  load_all_plugins();
  std::vector<uint64_t> parts = {scene.content_hash, plugins_hash()};
  for (const Technique& t : techniques) parts.push_back(scene.with(t, base).settings_hash);
  return fmt::format("{:016x}", hash_bytes(parts.data(), parts.size() * sizeof(uint64_t)));
}

uint64_t reference_seed(int technique) {
  return mix_bits(0x7265666572656e63ull + static_cast<uint64_t>(technique));
}

std::optional<Reference> make_reference(const LoadedScene& scene, const BuildOptions& base,
                                        const ReferenceRequest& request) {
  return Maker(scene, base, request).make();
}

}  // namespace pssmlt::compare
