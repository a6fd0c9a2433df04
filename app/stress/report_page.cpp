#include "app/stress/report_page.h"
#include <nlohmann/json.hpp>
namespace pssmlt::stress {
std::string report_page(const nlohmann::json& data) { return data.dump(); }
}  // namespace pssmlt::stress
