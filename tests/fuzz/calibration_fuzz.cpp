// Calibration files. Their checksum would stop nearly all of them at the door, so it is made right here, as whoever
// wants to do harm would.
#include "host/drives/calibration/calibration.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/sha256.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/model/config/tables.hpp"

using namespace liana;

namespace {

// The file with the arm's own name and hash, and the right checksum.
std::string with_checksum(std::string_view text, const config::RobotConfig& robot) {
  static const std::string kHash = config::sha256_hex(robot.canonical_json);
  Json content = Json::parse(text);
  if (!content.is_object()) return std::string(text);
  if (content.contains("robot_sha256")) content["robot_sha256"] = kHash;
  content.erase("sha256");
  content["sha256"] = config::sha256_hex(config::canonical_json(content));
  return content.dump();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const config::RobotConfig kArm = config::nominal_zhu2022();
  return fuzz::refusing([&] {
    config::RobotConfig arm = kArm;
    const std::string file = with_checksum(fuzz::text_of(data, size), kArm);
    calibration::apply(calibration::parse_calibration(file, "calibration", kArm, "2026-06-15"), arm);
  });
}
