// What a comparison ran on.
#pragma once

#include <nlohmann/json.hpp>

namespace pssmlt::compare {

// {"processor": name, "threads": logical processors, "memory_bytes"}
nlohmann::json machine_json();
// {"version", "libraries": {name: version}}
nlohmann::json program_json();
// Now, UTC: "2026-11-22T09:30:00Z".
std::string time_stamp();

}  // namespace pssmlt::compare
