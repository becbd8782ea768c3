// Teleoperation at its limits: random hand motions through the motion stage (filter, servo IK, limiter), judged tick by
// tick.
//
//   planning_teleop [--count N] [--first SEED] [--json] [--trace]
//
// Seed s is one motion of 10 s of the kind s % 8; then the hand goes back to the start pose, which is reachable, and
// waits for the arm. Every broken promise is listed with its seed; exit code 1 when there is one, 2 on bad input.
// --trace prints ten lines a second.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "firmware_like/cable/motion/motion.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana {

using namespace cable;
namespace {

using zhu2022::kThetas;
using zhu2022::Random;

constexpr double kMotion_s = 10.0;
constexpr double kReturn_s = 40.0;      // in which the arm has to come back
constexpr double kThere = 1e-6;         // m and rad
constexpr double kResidual = 1e-3;      // m; larger residuals have a direction worth judging
constexpr double kSameDirection = 0.9;  // cosine
constexpr double kRounding = 1e-9;
constexpr double kFollowed = 1e-5;  // m

enum Kind : std::size_t {
  kFree,
  kAtLimits,
  kOutOfReach,
  kFromStraight,
  kThroughStraight,
  kHolding,
  kJerky,
  kTurning,
  kKinds
};
constexpr std::array<const char*, kKinds> kKindNames{
    "free", "at limits", "out of reach", "from straight", "through straight", "holding", "jerky", "turning far"};

enum Cause : std::size_t {
  kNotANumber,
  kRate,
  kAcceleration,
  kJointLimit,
  kJump,
  kResidualDirection,
  kUnnamed,
  kStuck,
  kCauses
};
constexpr std::array<const char*, kCauses> kCauseNames{"not a number",      "rate limit",    "acceleration limit",
                                                       "joint limit",       "jump of theta", "residual direction",
                                                       "outcome not named", "never back"};

// Where the hand is: the start pose moved by a few sines per axis, or by steps, or drawn out to somewhere in the middle
// of the motion.
class Hand {
 public:
  Hand(Kind kind, const Pose& start, Random& random) : kind_(kind), start_(start) {
    const double reach_m = kind == kOutOfReach ? 1.5 : 0.4;
    const double turn_rad = kind == kTurning ? 1.5 : 0.5;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const double size = axis < 3 ? reach_m : turn_rad;
      for (Wave& wave : wave_[axis])
        wave = {random.uniform(0.0, size / 2), random.uniform(0.05, 0.4), random.uniform(0.0, 2.0 * kPi)};
    }
    for (Vec3& step : moves_) step = random.vector(0.3);
    for (Vec3& step : turns_) step = random.vector(0.6);
  }

  Pose at(double time_s) const {
    if (time_s >= kMotion_s) return start_;
    if (kind_ == kJerky) return jumped(time_s);
    Vec3 move{}, turn{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      move[axis] = sum(wave_[axis], time_s);
      turn[axis] = sum(wave_[axis + 3], time_s);
    }
    const double out = std::sin(kPi * time_s / kMotion_s);
    if (kind_ == kOutOfReach) move = add(move, scale(rotate(start_.quaternion, {1.0, 0.0, 0.0}), 2.0 * out));
    if (kind_ == kThroughStraight) {  // the stretched arm in the middle of the motion
      move = add(scale(move, 1.0 - out), scale(subtract({4.0, 0.0, 0.0}, start_.position_m), out));
      turn = add(scale(turn, 1.0 - out), scale(rotation_vector(conjugate(start_.quaternion)), out));
    }
    return moved(move, turn);
  }

 private:
  struct Wave {
    double size, hz, phase;
  };
  static double sum(const std::array<Wave, 3>& waves, double time_s) {
    double total = 0.0;
    for (const Wave& w : waves) total += w.size * (std::sin(2.0 * kPi * w.hz * time_s + w.phase) - std::sin(w.phase));
    return total;
  }
  // A jump a second, and 2 mm of tremor.
  Pose jumped(double time_s) const {
    const auto second = static_cast<std::size_t>(time_s);
    const double tremor_m = 0.002 * std::sin(2.0 * kPi * 9.0 * time_s);
    return moved(add(moves_[second], {tremor_m, tremor_m, tremor_m}), turns_[second]);
  }
  Pose moved(const Vec3& move_m, const Vec3& turn_rad) const {
    return {add(start_.position_m, move_m), normalize(multiply(quaternion_of(turn_rad), start_.quaternion))};
  }

  Kind kind_;
  Pose start_;
  std::array<std::array<Wave, 3>, 6> wave_{};
  std::array<Vec3, 10> moves_{}, turns_{};
};

// What one motion showed.
struct Figures {
  std::array<bool, kCauses> broken{};
  double step_deg = 0.0;      // largest change of what the IK asks for in a tick
  double step_deg_mm = 0.0;   // per mm that its target went, where that is a tenth of the speed limit or more
  double lag_deg = 0.0;       // command behind the IK
  double off_path_m = 0.0;    // tip of the command off the IK's target while the IK follows it
  double back_s = kReturn_s;  // after the hand
};

cable::ThetaVector start_theta(Kind kind, const cable::RobotParams& robot, Random& random) {
  if (kind == kFromStraight) return {};
  cable::ThetaVector theta = random.theta(robot, kind == kThroughStraight ? 1.5 : 12.0);
  for (std::size_t k = 0; k < kThetas && kind == kAtLimits; ++k) {
    if (random.uniform(0.0, 1.0) < 0.3) theta[k] = (theta[k] < 0.0 ? -1.0 : 1.0) * random.uniform(19.0, 20.0) * kDegree;
  }
  return theta;
}

class Trial {
 public:
  explicit Trial(std::uint64_t seed) : kind_(static_cast<Kind>(seed % kKinds)), random_(seed) {
    theta_ = start_theta(kind_, robot_, random_);
    reset_motion(robot_, theta_, state_);
  }

  Figures run(bool trace) {
    const Pose start = tip_of(theta_);
    const Hand hand(kind_, start, random_);
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_speed_m_s = robot_.limits.tip_speed_m_s;
    figures_.broken[kStuck] = true;
    for (std::int32_t i = 0; i * robot_.tick_s < kMotion_s + kReturn_s; ++i) {
      const double time_s = i * robot_.tick_s;
      if (i % robot_.interval_ticks == 0) {
        setpoint.tip_in_base = hand.at(time_s);
        if (kind_ == kHolding && i % 500 == 0) hold(setpoint, time_s >= kMotion_s);
        accept_setpoint(robot_, setpoint, state_);
      }
      tick();
      if (trace && i % 25 == 0) print(time_s);
      if (figures_.broken[kNotANumber]) break;
      if (time_s >= kMotion_s && zhu2022::length(pose_error(start, tip_of(state_.limiter.theta_rad))) < kThere) {
        figures_.back_s = time_s - kMotion_s;
        figures_.broken[kStuck] = false;
        break;
      }
    }
    return figures_;
  }

 private:
  Pose tip_of(const cable::ThetaVector& theta) const { return forward_kinematics(robot_, theta).tip_in_base; }

  // Some at random; none once the hand is back, so that the start pose can be reached again.
  void hold(cable::Setpoint& setpoint, bool none) {
    setpoint.held_mask = 0;
    for (std::size_t k = 0; k < kThetas && !none; ++k) {
      if (random_.uniform(0.0, 1.0) < 0.2) setpoint.held_mask |= 1u << k;
      setpoint.held_rad[k] = random_.uniform(-10.0, 10.0) * kDegree;
    }
  }

  void tick() {
    const cable::MotionState before = state_;
    advance_motion(robot_, cable_geometry(robot_, layout_, arm_trig(robot_, before.limiter.theta_rad)), true, state_);
    judge_command(before.limiter);
    judge_ik(before);
    judge_residual();
  }

  // Rates and accelerations are taken from the angles, not from what the limiter says about them.
  void judge_command(const cable::LimiterState& before) {
    for (std::size_t k = 0; k < kThetas; ++k) {
      const double theta = state_.limiter.theta_rad[k];
      const double rate = (theta - before.theta_rad[k]) / robot_.tick_s;
      if (!std::isfinite(theta)) figures_.broken[kNotANumber] = true;
      if (std::fabs(rate) > robot_.limits.theta_rate_rad_s + kRounding) figures_.broken[kRate] = true;
      if (std::fabs(rate - rate_[k]) > robot_.limits.theta_accel_rad_s2 * robot_.tick_s + kRounding)
        figures_.broken[kAcceleration] = true;
      if (std::fabs(theta) > robot_.segment[k / 2].theta_limit_rad + kRounding) figures_.broken[kJointLimit] = true;
      keep(figures_.lag_deg, std::fabs(state_.ik_rad[k] - theta) / kDegree);
      rate_[k] = rate;
    }
  }

  // A continuous target and no jump: in a tick the IK never asks for more than a joint can do.
  void judge_ik(const cable::MotionState& before) {
    const double step_rad = zhu2022::largest_difference(state_.ik_rad, before.ik_rad);
    const double target_m = norm(subtract(state_.filter.pose.position_m, before.filter.pose.position_m));
    keep(figures_.step_deg, step_rad / kDegree);
    if (target_m > 0.1 * robot_.limits.tip_speed_m_s * robot_.tick_s)
      keep(figures_.step_deg_mm, step_rad / kDegree / (1e3 * target_m));
    if (step_rad > robot_.limits.theta_rate_rad_s * robot_.tick_s + kRounding) figures_.broken[kJump] = true;
  }

  void judge_residual() {
    const Vec3 residual = subtract(state_.filter.pose.position_m, tip_of(state_.limiter.theta_rad).position_m);
    // Where the IK has the tip on its way, what is left is how far the joints lag.
    if (norm(subtract(state_.filter.pose.position_m, tip_of(state_.ik_rad).position_m)) < kFollowed)
      keep(figures_.off_path_m, norm(residual));
    const Vec3 reported{state_.ik.residual[0], state_.ik.residual[1], state_.ik.residual[2]};
    if (norm(residual) < kResidual || norm(reported) < kResidual) return;
    if (dot(residual, reported) < kSameDirection * norm(residual) * norm(reported))
      figures_.broken[kResidualDirection] = true;
    const bool too_far = norm(state_.filter.pose.position_m) > 4.0 + kResidual;
    if (state_.ik.outcome == IkOutcome::kConverged || (too_far && state_.ik.outcome != IkOutcome::kUnreachable)) {
      figures_.broken[kUnnamed] = true;
    }
  }

  void print(double time_s) const {
    std::printf("%7.3f s %-11s %.2e m %.2e rad limits %03x", time_s, ik_outcome_name(state_.ik.outcome),
                state_.ik.position_error_m, state_.ik.attitude_error_rad, state_.limits);
    for (const cable::ThetaVector& theta : {state_.ik_rad, state_.limiter.theta_rad}) {
      std::printf(" |");
      for (std::size_t k = 0; k < kThetas; ++k) std::printf(" %6.2f", theta[k] / kDegree);
    }
    std::printf("\n");
  }

  static void keep(double& largest, double value) { largest = std::max(largest, value); }

  Kind kind_;
  Random random_;
  cable::RobotParams robot_ = zhu2022::table();
  cable::CableLayout layout_ = cable_layout(robot_);
  cable::ThetaVector theta_{};
  cable::MotionState state_{};
  cable::ThetaVector rate_{};
  Figures figures_{};
};

struct Options {
  std::uint64_t first = 1, count = 1000;
  bool json = false, trace = false;
};

// Sums and maxima over the motions of a kind.
struct Row {
  std::uint64_t motions = 0, broken = 0;
  double step_deg = 0.0, step_deg_mm = 0.0, lag_deg = 0.0, off_path_m = 0.0, back_s = 0.0, back_sum_s = 0.0;

  void add(const Figures& f) {
    ++motions;
    broken += std::any_of(f.broken.begin(), f.broken.end(), [](bool b) { return b; });
    step_deg = std::max(step_deg, f.step_deg);
    step_deg_mm = std::max(step_deg_mm, f.step_deg_mm);
    lag_deg = std::max(lag_deg, f.lag_deg);
    off_path_m = std::max(off_path_m, f.off_path_m);
    back_s = std::max(back_s, f.back_s);
    back_sum_s += f.back_s;
  }
};

struct Study {
  std::array<Row, kKinds> row{};
  std::array<std::vector<std::uint64_t>, kCauses> seeds{};

  void add(std::uint64_t seed, const Figures& figures) {
    row[seed % kKinds].add(figures);
    for (std::size_t cause = 0; cause < kCauses; ++cause) {
      if (figures.broken[cause]) seeds[cause].push_back(seed);
    }
  }
  bool kept() const {
    return std::all_of(seeds.begin(), seeds.end(), [](const auto& list) { return list.empty(); });
  }
};

void print_text(const Study& study) {
  std::printf("%-17s %8s %7s %12s %12s %9s %12s %14s\n", "hand", "motions", "broken", "step deg", "deg per mm",
              "lag deg", "off path mm", "back s (mean)");
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const Row& r = study.row[kind];
    if (r.motions == 0) continue;
    std::printf("%-17s %8llu %7llu %12.4f %12.3f %9.3f %12.2f %7.1f (%.1f)\n", kKindNames[kind],
                static_cast<unsigned long long>(r.motions), static_cast<unsigned long long>(r.broken), r.step_deg,
                r.step_deg_mm, r.lag_deg, 1e3 * r.off_path_m, r.back_s, r.back_sum_s / static_cast<double>(r.motions));
  }
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    std::printf("%s: %zu", kCauseNames[cause], study.seeds[cause].size());
    for (const std::uint64_t seed : study.seeds[cause]) std::printf(" #%llu", static_cast<unsigned long long>(seed));
    std::printf("\n");
  }
}

void print_json(const Study& study) {
  std::printf("{\"kept\":%s,\"hands\":[", study.kept() ? "true" : "false");
  const char* comma = "";
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const Row& r = study.row[kind];
    if (r.motions == 0) continue;
    std::printf(
        "%s{\"hand\":\"%s\",\"motions\":%llu,\"broken\":%llu,\"step_deg\":%.6g,\"step_deg_per_mm\":%.6g,\"lag_deg\":%."
        "6g,",
        comma, kKindNames[kind], static_cast<unsigned long long>(r.motions), static_cast<unsigned long long>(r.broken),
        r.step_deg, r.step_deg_mm, r.lag_deg);
    std::printf("\"off_path_m\":%.6g,\"back_s\":%.4g,\"back_mean_s\":%.4g}", r.off_path_m, r.back_s,
                r.back_sum_s / static_cast<double>(r.motions));
    comma = ",";
  }
  std::printf("],\"violations\":[");
  comma = "";
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    for (const std::uint64_t seed : study.seeds[cause]) {
      std::printf("%s{\"cause\":\"%s\",\"seed\":%llu}", comma, kCauseNames[cause],
                  static_cast<unsigned long long>(seed));
      comma = ",";
    }
  }
  std::printf("]}\n");
}

bool read_number(const char* text, std::uint64_t& value) {
  const char* const end = text + std::strlen(text);
  const auto result = std::from_chars(text, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool read_options(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool number = word == "--count" || word == "--first";
    if (word == "--json") {
      options.json = true;
    } else if (word == "--trace") {
      options.trace = true;
    } else if (!number || i + 1 == argc || !read_number(argv[++i], word == "--count" ? options.count : options.first)) {
      std::fprintf(stderr, "planning_teleop: %s: allowed: --count N, --first SEED (whole numbers), --json, --trace\n",
                   argv[i]);
      return false;
    }
  }
  return true;
}

}  // namespace
}  // namespace liana

int main(int argc, char** argv) {
  liana::Options options;
  if (!liana::read_options(argc, argv, options)) return 2;
  liana::Study study;
  for (std::uint64_t seed = options.first; seed < options.first + options.count; ++seed) {
    study.add(seed, liana::Trial(seed).run(options.trace));
  }
  options.json ? liana::print_json(study) : liana::print_text(study);
  return study.kept() ? 0 : 1;
}
