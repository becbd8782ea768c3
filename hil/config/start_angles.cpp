#include "hil/config/start_angles.hpp"

#include <sstream>
#include <stdexcept>

#include "hil/config/fields.hpp"

namespace liana::bench {

std::vector<double> start_angles_rad(const std::map<std::string, std::vector<double>>& named_poses_rad,
                                     std::size_t count, const std::string& text) {
  if (const auto pose = named_poses_rad.find(text); pose != named_poses_rad.end()) return pose->second;
  std::vector<double> angles_rad;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    std::istringstream number(word);
    double angle_deg = 0.0;
    if (!(number >> angle_deg) || !number.eof() || angle_deg < -360.0 || angle_deg > 360.0) break;
    angles_rad.push_back(kRadPerDeg * angle_deg);
  }
  if (angles_rad.size() == count && words.eof()) return angles_rad;
  std::string names;
  for (const auto& [name, pose] : named_poses_rad) names += (names.empty() ? "" : ", ") + name;
  throw std::runtime_error("--start-pose: \"" + text + "\" is not in the robot's named_poses_deg; allowed are " +
                           names + ", or " + std::to_string(count) + " angles in degrees, -360..360, comma-separated");
}

}  // namespace liana::bench
