// Whether the tables of a run fit into one packet.
#pragma once

#include <string>

namespace liana::api {

// The welcome carries all three tables (canonical JSON), and whoever cannot get it can join nothing. Throws
// std::runtime_error with the bytes of each where they are more than one packet holds.
void require_fit_in_welcome(const std::string& robot_json, const std::string& scene_json,
                            const std::string& buses_json);

}  // namespace liana::api
