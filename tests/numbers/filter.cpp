// What the operator filter makes of a hand, beside other filters that are as late, and how a true tip follows one.
// `--count` seeds of tremor and of the arm. Columns of every filter: lag behind 30 and 100 mm/s; attenuation of 1 mm at
// 8, 10 and 12 Hz and the least between; largest gain below 7 Hz; past the end of a reach of 60 mm in 2 s, and the
// swing it leaves in a mode of 0.6 Hz with damping 1 /s; RMS left of 0.5 mm of tremor, 8 to 12 Hz, sampled at 90 Hz and
// averaged over command intervals as a device's samples are.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "firmware_like/cable/motion/motion.hpp"
#include "firmware_like/math/trig.hpp"
#include "tests/closed_loop/fixture.hpp"
#include "tests/closed_loop/hand_to_tip.hpp"
#include "tests/numbers/filter_rivals.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

using cable::MotionLimits;
using closed_loop::Following;
using closed_loop::Led;

constexpr double kTick_s = 0.004;
constexpr double kTurn = 2.0 * std::numbers::pi;

// One coordinate, tick by tick; a fresh one for every trial.
using Filter = std::function<double(double)>;
using Make = std::function<Filter()>;

Filter tremor_stage() {
  return [state = TremorState{}](double in) mutable {
    return without_tremor({{in, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, kTick_s, state).pose.position_m[0];
  };
}

Filter tip_filter(const MotionLimits& limits) {
  cable::RobotParams table = closed_loop::robot_table();
  table.limits = limits;
  const TipFilterConfig config = cable::tip_filter_config(table, 0.0);
  return [config, state = TipFilterState{}](double in) mutable {
    filter_tip(config, {{in, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, state);
    return state.pose.position_m[0];
  };
}

template <class Rival>
Filter rival(Rival made) {
  return [made](double in) mutable { return made.step(in); };
}

// At constant speed, after 10 s.
double lag_s(const Make& make, double speed_m_s) {
  const Filter filter = make();
  double in = 0.0, out = 0.0;
  for (double t_s = 0.0; t_s < 10.0; t_s += kTick_s) out = filter(in += speed_m_s * kTick_s * std::min(1.0, t_s));
  return (in - out) / speed_m_s;
}

// The value of `knob` in low..high, rising, at which the lag at 30 mm/s has fallen to this.
double knob_for(double lag_wanted_s, double low, double high, const std::function<Make(double)>& make) {
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (lag_s(make(middle), 0.03) > lag_wanted_s ? low : high) = middle;
  }
  return high;
}

double gain_dB(const Make& make, double frequency_hz) {
  constexpr double kSize_m = 0.001;
  constexpr int kTicks = 5000;
  const Filter filter = make();
  double in_phase = 0.0, across = 0.0;
  for (int i = 0; i < 2 * kTicks; ++i) {
    const double phase = kTurn * frequency_hz * i * kTick_s, out = filter(kSize_m * std::sin(phase));
    if (i < kTicks) continue;
    in_phase += out * std::sin(phase);
    across += out * std::cos(phase);
  }
  return 20.0 * std::log10(2.0 * std::hypot(in_phase, across) / kTicks / kSize_m + 1e-12);
}

double largest_gain_dB(const Make& make, double from_hz, double to_hz) {
  double largest = -1e9;
  for (double hz = from_hz; hz < to_hz + 1e-9; hz += 0.25) largest = std::max(largest, gain_dB(make, hz));
  return largest;
}

struct Reach {
  double over_mm = 0.0, swing_mm = 0.0;
};
Reach reach_of(const Make& make) {
  constexpr double kWay_m = 0.06, kSeconds = 2.0, kMode = kTurn * 0.6, kDamping = 2.0;
  const Filter filter = make();
  Reach out;
  double place = 0.0, rate = 0.0;
  for (double t_s = 0.0; t_s < 8.0; t_s += kTick_s) {
    const double root = filter(kWay_m * closed_loop::minimum_jerk(std::min(1.0, t_s / kSeconds)));
    rate -= kTick_s * (kDamping * rate + kMode * kMode * (place - root));
    place += kTick_s * rate;
    out.over_mm = std::max(out.over_mm, 1000.0 * (root - kWay_m));
    out.swing_mm = std::max(out.swing_mm, 1000.0 * std::fabs(place - root));
  }
  return out;
}

// Tremor of 0.5 mm RMS as seven sines, and what is left of it.
double tremor_left_mm(const Make& make, std::uint64_t seed) {
  constexpr double kInterval_s = 0.02, kSample_s = 1.0 / 90.0, kSeconds = 30.0;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> hz(8.0, 12.0), phase(0.0, kTurn);
  std::array<std::array<double, 2>, 7> sines;
  for (auto& sine : sines) sine = {hz(random), phase(random)};
  const Filter filter = make();
  double from = 0.0, to = 0.0, sum2 = 0.0, sample_s = 0.0;
  int ticks = 0;
  for (double t_s = 0.0; t_s < kSeconds; t_s += kInterval_s) {
    double sum = 0.0;
    int samples = 0;
    for (; sample_s < t_s + kInterval_s; sample_s += kSample_s, ++samples)
      for (const auto& sine : sines) sum += 0.5 * std::sqrt(2.0 / 7.0) * std::sin(kTurn * sine[0] * sample_s + sine[1]);
    from = std::exchange(to, samples > 0 ? sum / samples : to);
    for (int i = 1; i <= 5; ++i) {
      const double left = filter(0.001 * (from + (to - from) * i / 5.0));
      if (t_s < 2.0) continue;
      sum2 += left * left;
      ++ticks;
    }
  }
  return 1000.0 * std::sqrt(sum2 / ticks);
}

std::string line_of(const std::string& name, const Make& make, std::int32_t seeds) {
  const Reach reach = reach_of(make);
  double left_mm = 0.0;
  for (std::int32_t seed = 1; seed <= seeds; ++seed)
    left_mm = std::max(left_mm, tremor_left_mm(make, static_cast<std::uint64_t>(seed)));
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(),
                R"({"name":"%s","lag_30_s":%.4f,"lag_100_s":%.4f,"dB_8":%.2f,"dB_10":%.2f,"dB_12":%.2f,"dB_band":%.2f,)"
                R"("dB_below_7":%.3f,"over_mm":%.3f,"swing_mm":%.2f,"tremor_left_mm":%.5f})",
                name.c_str(), lag_s(make, 0.03), lag_s(make, 0.0999), gain_dB(make, 8.0), gain_dB(make, 10.0),
                gain_dB(make, 12.0), largest_gain_dB(make, 8.0, 12.0), largest_gain_dB(make, 0.25, 6.75), reach.over_mm,
                reach.swing_mm, left_mm);
  return text.data();
}

// Ours, and the rivals that are as late at 30 mm/s.
void add_filter(const std::string& name, const Make& make, std::int32_t seeds, std::vector<std::string>& lines) {
  const double late_s = lag_s(make, 0.03);
  const auto euro = [](double cutoff_hz) {
    return Make([cutoff_hz] { return rival(OneEuro(cutoff_hz, 10.0, kTick_s)); });
  };
  const auto low = [](double cutoff_hz) { return Make([cutoff_hz] { return rival(LowPass(cutoff_hz, kTick_s)); }); };
  lines.push_back(line_of(name, make, seeds));
  lines.push_back(line_of("1-Euro", euro(knob_for(late_s, 0.001, 100.0, euro)), seeds));
  lines.push_back(line_of("low-pass", low(knob_for(late_s, 0.01, 100.0, low)), seeds));
}

MotionLimits limits_before() {
  MotionLimits limits = closed_loop::robot_table().limits;
  limits.tip_accel_m_s2 = 0.14;
  limits.tip_jerk_m_s3 = 1.0;
  limits.tip_angular_accel_rad_s2 = 40.0 * kDegree;
  limits.tip_angular_jerk_rad_s3 = 400.0 * kDegree;
  limits.tip_lag_s = 0.0;
  return limits;
}

// Speed 0: a reach.
Following led_once(const closed_loop::PlantSetup& setup, const MotionLimits& limits, const Led& led, double speed_m_s) {
  closed_loop::ArmToLead arm(setup, limits);
  arm.settle(led);
  return speed_m_s > 0.0 ? follow_steadily(arm, led, speed_m_s) : follow_reach(arm, led, 0.06, 2.0);
}

// The lag of the exact arm, and the worst of the seeds.
std::string led_line(const char* name, const char* what, const MotionLimits& limits, const Led& led, double speed_m_s,
                     std::int32_t seeds) {
  Following worst;
  worst.lag_s = led_once(closed_loop::exact_arm(led), limits, led, speed_m_s).lag_s;
  for (std::int32_t seed = 1; seed <= seeds; ++seed) {
    const Following found =
        led_once(closed_loop::real_arm(led, static_cast<std::uint64_t>(seed)), limits, led, speed_m_s);
    worst.swing_mm = std::max(worst.swing_mm, found.swing_mm);
    worst.overshoot_mm = std::max(worst.overshoot_mm, found.overshoot_mm);
    worst.least_N = std::min(worst.least_N, found.least_N);
    worst.faults += found.faults;
  }
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(),
                R"({"limits":"%s","what":"%s","lag_s":%.4f,"swing_mm":%.2f,"over_mm":%.2f,"least_N":%.2f,"faults":%d})",
                name, what, worst.lag_s, worst.swing_mm, worst.overshoot_mm, worst.least_N, worst.faults);
  return text.data();
}

void print_list(const char* name, const std::vector<std::string>& lines, const char* end) {
  std::printf("\"%s\":[", name);
  for (std::size_t i = 0; i < lines.size(); ++i) std::printf("%s%s", i > 0 ? ",\n" : "\n", lines[i].c_str());
  std::printf("]%s", end);
}

void run(std::int32_t seeds) {
  const MotionLimits now = closed_loop::robot_table().limits, before = limits_before();
  std::vector<std::string> filters, led;
  add_filter(
      "tremor stage", [] { return tremor_stage(); }, seeds, filters);
  add_filter(
      "tip filter", [&] { return tip_filter(now); }, seeds, filters);
  add_filter(
      "tip filter, limits of old", [&] { return tip_filter(before); }, seeds, filters);
  const Led free,
      in_slit{"segment5_in_slit", scale(closed_loop::scene().slit->u_axis, -1.0), now.tip_speed_slit_m_s, 0x100};
  for (const auto& [name, limits] : {std::pair{"old", &before}, std::pair{"table", &now}}) {
    led.push_back(led_line(name, "free, 99 mm/s", *limits, free, 0.099, seeds));
    led.push_back(led_line(name, "out of the slit, 29.7 mm/s", *limits, in_slit, 0.0297, seeds));
    led.push_back(led_line(name, "free, reach of 60 mm in 2 s", *limits, free, 0.0, seeds));
  }
  std::printf("{");
  print_list("filters", filters, ",\n");
  print_list("led", led, "}\n");
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  liana::numbers::run(liana::numbers::parse_options(argc, argv, 3).count);
  return 0;
}
