#include "host/apps/cli/tracker_export.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/math/trig.hpp"
#include "host/apps/report/truth.hpp"
#include "host/base/file/out_file.hpp"
#include "host/base/json/json.hpp"
#include "host/base/random/random.hpp"
#include "host/drives/calibration/hand_eye.hpp"
#include "host/drives/calibration/text.hpp"
#include "host/model/config/field.hpp"

namespace liana::cli {
namespace {

constexpr double kRow_s = 0.02, kNoise_m = 0.2e-3, kNoise_rad = 0.1 * kDegree;
constexpr std::uint64_t kFrames = 1, kNoise = 2;            // purposes of random numbers
constexpr double kMaxAway_m = 2.0, kMaxOnTip_m = 0.1;       // along each axis
constexpr double kMaxTurn_rad = 1.0, kMaxClock_s = 1000.0;  // about each axis; between the clocks

Pose drawn(simulated::RandomStream& random, double max_m, double max_rad) {
  const auto vector = [&](double max) {
    return Vec3{random.uniform(-max, max), random.uniform(-max, max), random.uniform(-max, max)};
  };
  const Vec3 position_m = vector(max_m);
  return {position_m, quaternion_of(vector(max_rad))};
}

Pose with_noise(const Pose& pose, simulated::RandomStream& random) {
  const auto vector = [&](double sd) { return Vec3{random.normal(sd), random.normal(sd), random.normal(sd)}; };
  const Vec3 off_m = vector(kNoise_m);
  return {add(pose.position_m, off_m), multiply(quaternion_of(vector(kNoise_rad)), pose.quaternion)};
}

}  // namespace

std::uint64_t write_tracker(const archive::Reader& reader, archive::Span span, const std::string& path, double zero_s) {
  const std::string folder = reader.folder() + "/";
  const report::TruthLog truth = report::TruthLog::load(folder + "truth.bin");
  const std::uint64_t seed =
      Json::parse_or_null(config::read_text_file(folder + "bench_summary.json")).value("seed", std::uint64_t{0});
  simulated::RandomStream frames(seed, kFrames), noise(seed, kNoise);
  const calibration::HandEye tracker{drawn(frames, kMaxAway_m, kMaxTurn_rad), drawn(frames, kMaxOnTip_m, kMaxTurn_rad)};
  const double drawn_s = frames.uniform(0.0, kMaxClock_s), clock_s = zero_s != 0.0 ? zero_s : drawn_s;
  const double period_s = reader.life().period_s;
  const auto every = static_cast<std::size_t>(std::max(1L, std::lround(kRow_s / period_s)));
  file::OutFile out(path);
  out.write("time_s,x_m,y_m,z_m,qw,qx,qy,qz\n");
  std::uint64_t rows = 0;
  for (std::size_t row = 0; row < truth.row_count(); row += every) {
    const double slot = truth.at(row, "slot");
    if (slot < static_cast<double>(span.first) || slot > static_cast<double>(span.last)) continue;
    const Pose seen = with_noise(tracker.marker_in_tracker(truth.tip(row)), noise);
    const Vec3& p = seen.position_m;
    const Quat& q = seen.quaternion;
    out.write(calibration::text("%.4f,%.6f,%.6f,%.6f,%.7f,%.7f,%.7f,%.7f\n", slot * period_s + clock_s, p[0], p[1],
                                p[2], q[0], q[1], q[2], q[3]));
    ++rows;
  }
  out.finish();
  return rows;
}

}  // namespace liana::cli
