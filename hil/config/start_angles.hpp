// Where an arm starts, as the command line gives it.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace liana::bench {

// `count` angles [rad] from the name of a pose, or from as many angles in degrees, "t1,t2,...". Throws
// std::runtime_error naming --start-pose and what is allowed.
std::vector<double> start_angles_rad(const std::map<std::string, std::vector<double>>& named_poses_rad,
                                     std::size_t count, const std::string& text);

}  // namespace liana::bench
