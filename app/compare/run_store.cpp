#include "app/compare/run_store.h"

#include <fmt/format.h>

#include "app/compare/text.h"
#include "core/base/error.h"
#include "core/base/log.h"

namespace pssmlt::compare {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

void check_identity(const fs::path& file, const json& wanted) {
  json found;
  try {
    found = json::parse(read_file(file.string()));
  } catch (const json::exception&) {
    throw Error("cannot resume: \"" + file.string() + "\" is damaged");
  }
  std::string different;
  for (const auto& [key, value] : wanted.items()) {
    if (!found.contains(key) || found[key] != value) {
      different += (different.empty() ? "" : ", ") + key;
    }
  }
  if (!different.empty()) {
    throw Error("cannot resume: the report in \"" + file.parent_path().parent_path().string() +
                "\" has other " + different);
  }
}

bool is_run(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("scene") && (file.extension() == ".json" || file.extension() == ".part");
}

}  // namespace

RunStore::RunStore(const fs::path& report, const json& identity, bool resume)
    : folder_(report / "runs") {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) throw Failure("cannot make " + folder_.string() + ": " + failed.message());
  const fs::path state = folder_ / "state.json";
  if (resume && fs::exists(state, failed)) {
    check_identity(state, identity);
    return;
  }
  if (resume) log_info("there are no runs in \"" + report.string() + "\" yet: starting anew");
  for (const auto& entry : fs::directory_iterator(folder_, failed)) {
    if (is_run(entry.path())) fs::remove(entry.path(), failed);
  }
  write_file(state.string(), identity.dump(2) + "\n");
}

std::string RunStore::file(int scene, int run) const {
  return (folder_ / fmt::format("scene{}-run{}.json", scene, run)).string();
}

std::optional<std::vector<RunRecord>> RunStore::load(int scene, int run, uint64_t reference) const {
  const std::string path = file(scene, run);
  std::error_code failed;
  if (!fs::exists(path, failed)) return std::nullopt;
  std::vector<RunRecord> records;
  try {
    const json j = json::parse(read_file(path));
    if (j.at("reference").get<uint64_t>() != reference) {
      throw Error(
          "cannot resume: the reference is not the one that the finished runs were measured "
          "against (another --reference, or a longer --reference-time)");
    }
    for (const json& r : j.at("techniques")) records.push_back(record_from_json(r));
  } catch (const json::exception& damage) {
    log_warning("\"" + path + "\" is damaged, the run is repeated: " + damage.what());
    return std::nullopt;
  }
  return records;
}

void RunStore::save(int scene, int run, uint64_t reference,
                    const std::vector<RunRecord>& records) const {
  json j = {{"reference", reference}, {"techniques", json::array()}};
  for (const RunRecord& r : records) j["techniques"].push_back(record_to_json(r));
  write_file(file(scene, run), j.dump() + "\n");
}

}  // namespace pssmlt::compare
