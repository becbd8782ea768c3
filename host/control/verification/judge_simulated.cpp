#include "host/control/verification/judge_simulated.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware_like/cable/arm/let_go.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/control/verification/judge.hpp"
#include "host/control/verification/tick_time.hpp"
#include "host/control/virtual_fixtures/forbidden.hpp"

namespace liana::verification {

namespace {

using Index = std::size_t;
using simulation::Moment;

constexpr double kEvenRate = 1.01;  // rates of the sequence are means over an interval of what the twin did in ticks
constexpr double kTipLead = 1.05;   // the same allowance as the execution end's

std::string numbered(const char* what, Index index) { return what + std::string(" ") + std::to_string(index + 1); }

constexpr double kPhase_s = 0.05;   // the same swing may come so much later
constexpr double kNoWorse_N = 2.0;  // of an arm that plans 40 N
constexpr double kNoFaster = 1.02;

// How the arm swings when nothing more is asked of it: of every moment, the least tensions and the largest speeds from
// there on.
class StopSwing {
 public:
  explicit StopSwing(const simulation::Motion* stop) {
    if (stop == nullptr || !stop->solved) return;
    from_ = stop->moments;
    for (Index i = from_.size(); i-- > 1;) widen(from_[i - 1], from_[i]);
  }

  // From `time_s` on; a moment without speeds where nothing is known, or where the motion was over before.
  const Moment& from(double time_s) const {
    const auto later = [](const Moment& moment, double t_s) { return moment.time_s < t_s; };
    const auto first = std::lower_bound(from_.begin(), from_.end(), time_s - kPhase_s, later);
    return first == from_.end() ? none_ : *first;
  }

 private:
  static Moment without() {
    Moment none;
    none.tension_N.fill(kTaut_N);
    return none;
  }
  static void widen(Moment& moment, const Moment& next) {
    for (Index c = 0; c < next.tension_N.size(); ++c)
      moment.tension_N[c] = std::fmin(moment.tension_N[c], next.tension_N[c]);
    for (Index k = 0; k < next.rate_rad_s.size(); ++k)
      moment.rate_rad_s[k] = std::fmax(std::fabs(moment.rate_rad_s[k]), std::fabs(next.rate_rad_s[k]));
    for (Index m = 0; m < next.node_speed_m_s.size(); ++m)
      moment.node_speed_m_s[m] = std::fmax(moment.node_speed_m_s[m], next.node_speed_m_s[m]);
    moment.tip_rate_rad_s = std::fmax(moment.tip_rate_rad_s, next.tip_rate_rad_s);
  }

  static constexpr double kTaut_N = 1e6;
  std::vector<Moment> from_;
  Moment none_ = without();
};

// Checks of every moment, in the order of time; remembers when and where the first one failed.
class MomentJudge {
 public:
  MomentJudge(const MotionRules& rules, const simulation::Motion* stop, SimulationVerdict& verdict)
      : table_(rules.table), zone_(rules.zone), stop_(stop), verdict_(verdict), judge_(verdict, &rules.table) {}

  void told(const simulation::JointSequence& sequence) {
    for (Index row = 0; row < sequence.rows_rad.size(); ++row) {
      const cable::ThetaVector& now = sequence.rows_rad[row];
      const cable::ThetaVector& before = sequence.rows_rad[row > 0 ? row - 1 : 0];
      for (Index k = 0; k < thetas(); ++k) {
        const double limit_rad = max_rad(sequence, k);
        const double rate_rad_s = (now[k] - before[k]) / sequence.interval_s;
        judge_.check(Refusal::kJointAngle, "theta", kDegrees, static_cast<int>(k), now[k], limit_rad);
        judge_.check(Refusal::kJointRate, "rate of theta", kDegreesPerSecond, static_cast<int>(k), rate_rad_s,
                     kEvenRate * table_.limits.theta_rate_rad_s);
        least(verdict_.margins.joint_deg, (limit_rad - std::fabs(now[k])) / kDegree);
        least(verdict_.margins.rate_deg_s, (table_.limits.theta_rate_rad_s - std::fabs(rate_rad_s)) / kDegree);
        note("theta", k, static_cast<double>(row) * sequence.interval_s);
      }
    }
  }

  void told_tip(const simulation::Motion& motion, double interval_s) {
    const std::vector<Vec3>& tip_m = motion.told_tip_in_base_m;
    for (Index row = 1; row < tip_m.size(); ++row) {
      judge_.check(Refusal::kTipSpeed, "tip speed", kMetresPerSecond, -1,
                   norm(subtract(tip_m[row], tip_m[row - 1])) / interval_s,
                   kTipLead * zone_.limit_at(tip_m[row], table_.limits.tip_speed_m_s));
      note("tip", kNoIndex, static_cast<double>(row) * interval_s);
    }
  }

  void simulated(const simulation::JointSequence& sequence, const simulation::Motion& motion) {
    const cable::CableVector plan_N = sequence.tensions_N.empty() ? cable::CableVector{} : sequence.tensions_N.front();
    const cable::ThetaVector bounds_rad = allowed_rad(sequence, motion);
    for (const Moment& moment : motion.moments) {
      const Moment& anyway = stop_.from(moment.time_s);
      joints(bounds_rad, motion.friction_band_rad, moment, anyway);
      nodes(moment, anyway);
      cables(plan_N, moment, anyway, motion.min_passed_share);
    }
  }

  void conclude() { judge_.conclude(); }
  Judge& judge() { return judge_; }

 private:
  Index thetas() const { return static_cast<Index>(table_.theta_count()); }
  static void least(double& margin, double value) { margin = std::fmin(margin, value); }

  // An arm that stands beyond a range already goes no further out.
  double max_rad(const simulation::JointSequence& sequence, Index k) const {
    return std::fmax(table_.segment[k / 2].theta_limit_rad, std::fabs(sequence.rows_rad.front()[k]));
  }

  // Friction may hold an angle as far out from the beginning.
  cable::ThetaVector allowed_rad(const simulation::JointSequence& sequence, const simulation::Motion& motion) const {
    cable::ThetaVector allowed{};
    for (Index k = 0; k < thetas(); ++k) {
      const double stands_rad = std::fabs(motion.moments.front().theta_rad[k]) + motion.friction_band_rad[k];
      allowed[k] = std::fmax(max_rad(sequence, k), stands_rad) + kSwingAngle_rad;
    }
    return allowed;
  }

  void joints(const cable::ThetaVector& allowed_rad, const cable::ThetaVector& friction_band_rad, const Moment& moment,
              const Moment& anyway) {
    for (Index k = 0; k < thetas(); ++k) {
      judge_.check(Refusal::kJointAngle, "simulated theta", kDegrees, static_cast<int>(k),
                   std::fabs(moment.theta_rad[k]) + friction_band_rad[k], allowed_rad[k]);
      judge_.check(Refusal::kJointRate, "simulated rate of theta", kDegreesPerSecond, static_cast<int>(k),
                   moment.rate_rad_s[k],
                   std::fmax(kSwingRate * table_.limits.theta_rate_rad_s, kNoFaster * std::fabs(anyway.rate_rad_s[k])));
      note("theta", k, moment.time_s);
    }
  }

  void nodes(const Moment& moment, const Moment& anyway) {
    const auto allowed = [](double limit, double speed) { return std::fmax(limit, kNoFaster * speed); };
    const auto tip = static_cast<Index>(table_.segment_count) - 1;
    const double tip_m_s = zone_.limit_at(moment.node_in_base_m[tip], table_.limits.tip_speed_m_s);
    for (Index m = 0; m < tip; ++m) {
      judge_.check(Refusal::kNodeSpeed, "speed of node", kMetresPerSecond, static_cast<int>(m),
                   moment.node_speed_m_s[m],
                   allowed(kNodeShare * table_.limits.tip_speed_m_s, anyway.node_speed_m_s[m]));
      note("node", m, moment.time_s);
    }
    judge_.check(Refusal::kTipSpeed, "simulated tip speed", kMetresPerSecond, -1, moment.node_speed_m_s[tip],
                 allowed(kSwingTip * tip_m_s, anyway.node_speed_m_s[tip]));
    judge_.check(Refusal::kTipSpeed, "simulated tip turn rate", kDegreesPerSecond, -1, moment.tip_rate_rad_s,
                 allowed(kSwingTip * table_.limits.tip_rate_rad_s, anyway.tip_rate_rad_s));
    note("tip", kNoIndex, moment.time_s);
  }

  void cables(const cable::CableVector& plan_N, const Moment& moment, const Moment& anyway,
              const cable::CableVector& passed_share) {
    const cable::TensionLimits& limits = table_.tension;
    const double unsure_N = kSwingTension_N * limits.scale();
    const auto cables = static_cast<Index>(table_.cable_count());
    for (Index c = static_cast<Index>(table_.feed_count()); c < cables; ++c) {
      if (cable::is_planned_released(table_, plan_N, c)) continue;
      const double tension_N = moment.tension_N[c];
      const double left_N = (tension_N - unsure_N) * passed_share[c] - limits.floor_anywhere_N;
      judge_.check(Refusal::kSwingTension, "tension with inertia of cable", kNewtons, static_cast<int>(c),
                   tension_N + unsure_N, limits.alarm_N);
      const bool swings_so_anyway = tension_N >= anyway.tension_N[c] - kNoWorse_N * limits.scale();
      if (left_N < 0.0 && !swings_so_anyway && verdict_.passed()) {
        judge_.refuse(Refusal::kSwingTension,
                      slack_text(c, tension_N, limits.floor_anywhere_N / passed_share[c] + unsure_N));
      }
      least(verdict_.margins.tension_N, std::fmin(limits.alarm_N - tension_N - unsure_N, left_N));
      if (is_first_limit()) verdict_.first = {config::DriveNames(table_).cable(c), moment.time_s};
    }
  }

  std::string slack_text(Index c, double tension_N, double asked_N) const {
    char text[80];
    std::snprintf(text, sizeof text, " would have %.1f N at the motor, %.1f N are asked for", tension_N, asked_N);
    return "slack with inertia: " + config::DriveNames(table_).cable(c) + text;
  }

  bool is_first_limit() const { return !verdict_.passed() && verdict_.first.body.empty(); }

  static constexpr Index kNoIndex = ~Index{0};

  void note(const char* what, Index index, double time_s) {
    if (!is_first_limit()) return;
    verdict_.first = {index == kNoIndex ? what : numbered(what, index), time_s};
  }

  const cable::RobotParams& table_;
  const arbiter::SpeedZone& zone_;
  StopSwing stop_;
  SimulationVerdict& verdict_;
  Judge judge_;
};

// The farthest that any node is moved.
double travel_m(const cable::RobotParams& table, const simulation::Motion& motion) {
  double most_m = 0.0;
  if (motion.moments.empty()) return most_m;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const Vec3 way_m = subtract(motion.moments.back().node_in_base_m[m], motion.moments.front().node_in_base_m[m]);
    most_m = std::fmax(most_m, norm(way_m));
  }
  return most_m;
}

// When the tip passes a wall of the fixture from between them, and by how much; nothing where it does not. A tip that
// is beyond a wall already may go back, and by what the noise of a measured pose gives away no farther; one in the room
// behind a wall, where it came past none, is no concern of theirs.
void judge_walls(const MotionRules& rules, const config::SceneFixture& walls, const simulation::Motion& motion,
                 SimulationVerdict& verdict) {
  const auto tip = static_cast<Index>(rules.table.segment_count - 1);
  double allowed_m = 0.0;
  bool was_between = false;
  for (const Moment& moment : motion.moments) {
    const auto beyond =
        virtual_fixtures::beyond_walls(walls, rules.arm_radius_m, rules.drawing_in_base, moment.node_in_base_m[tip]);
    const bool concerns = beyond && (was_between || beyond->is_between);
    was_between = concerns;
    if (!concerns) continue;
    if (&moment == &motion.moments.front() && beyond->depth_m > 0.0) allowed_m = beyond->depth_m + kGivenAway_m;
    if (beyond->depth_m <= allowed_m) continue;
    return refuse(verdict, Refusal::kFixture,
                  "the tip would pass the walls of fixture " + walls.name + " by " + in_millimetres(beyond->depth_m) +
                      ", allowed " + in_millimetres(allowed_m),
                  {walls.name, moment.time_s});
  }
}

}  // namespace

SimulationVerdict judge_simulated(const MotionRules& rules, const simulation::JointSequence& sequence,
                                  bool comes_to_rest, const simulation::Motion& motion, TooNear& too_near,
                                  const simulation::Motion* stop) {
  SimulationVerdict verdict;
  if (!motion.solved) {
    refuse(verdict, Refusal::kNotFinite, "the simulated arm's equations have no solution", {});
    return verdict;
  }
  verdict.margins = {0.0, 1e3, 1e3, 1e6, 0.0};
  judge_distances(rules.scene, motion.distances, plain_link_name, travel_m(rules.table, motion), too_near, verdict);
  const First nearest = verdict.first;
  for (const config::SceneFixture& fixture : rules.scene.fixtures)
    if (verdict.passed()) judge_walls(rules, fixture, motion, verdict);
  if (verdict.passed()) verdict.first = {};
  MomentJudge moments(rules, stop, verdict);
  moments.told(sequence);
  moments.told_tip(motion, sequence.interval_s);
  moments.simulated(sequence, motion);
  moments.judge().require(comes_to_rest, Refusal::kNoRest, "the arm would not come to rest in time after the command");
  moments.conclude();
  judge_tick_time(rules.table, rules.machine, verdict);
  if (verdict.first.body.empty()) verdict.first = nearest;
  return verdict;
}

}  // namespace liana::verification
