#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "drawn_hand.hpp"
#include "fixture.hpp"
#include "verified_arm.hpp"

using namespace liana;
using namespace liana::closed_loop;

int main(int argc, char** argv) {
  const int first = argc > 1 ? std::atoi(argv[1]) : 1, count = argc > 2 ? std::atoi(argv[2]) : 10;
  const char* physics = argc > 3 ? argv[3] : "nominal";
  const double scale = argc > 4 ? std::atof(argv[4]) : 1.0;
  const bool trace = argc > 5;
  const char* poses[] = {"prepare", "panel_edge", "zero", "fixture", "segment5_in_slit"};
  std::vector<double> least_all, motor_all, speed_all, refused_all;
  int faulted = 0;
  for (int seed = first; seed < first + count; ++seed) {
    PlantSetup setup{physics, static_cast<std::uint64_t>(seed), true, poses[seed % 5]};
    if (std::strcmp(physics, "exact") == 0) setup = {"ideal", 1, false, poses[seed % 5]};
    std::unique_ptr<VerifiedArm> owned;
    try {
      owned = std::make_unique<VerifiedArm>(setup, true);
    } catch (const std::exception& e) {
      std::printf("%d not enabled: %s\n", seed, e.what());
      continue;
    }
    VerifiedArm& arm = *owned;
    HandBounds bounds;
    bounds.speed_m_s *= scale, bounds.accel_m_s2 *= scale, bounds.rate_rad_s *= scale, bounds.accel_rad_s2 *= scale;
    DrawnHand hand(static_cast<std::uint64_t>(seed), bounds);
    arbiter::DeviceUse use;
    use.kind = device::Kind::kHandController;
    use.speed_m_s = arm.arm().table().limits.tip_speed_m_s;
    arm.arbiter().use_device(arm.arm().outputs(), use);
    const auto& g = arm.arm().controller().arm().motion().governor;
    std::printf("    governor linear %.2f angular %.2f room %.0f %.0f %.0f %.0f %.0f\n", g.linear_share,
                g.angular_share, g.room_N[0], g.room_N[1], g.room_N[2], g.room_N[3], g.room_N[4]);
    double contact = 0.0, t = 0.0, least = 1e9, motor = 1e9, speed = 0.0, most = 0.0, plan_most = 0.0, pred_gap = 1e9,
           lag = 0.0;
    Vec3 tip = arm.arm().plant().tip_in_base().position_m;
    double window = 0.0;
    Vec3 window_tip = tip;
    (void)window;
    double least_at = 0;
    int fault = 0;
    double e2 = 0, r2 = 0, m2 = 0;
    cable::ThetaVector rate0{};
    int en = 0;
    (void)rate0;
    std::map<int, int> codes;
    std::size_t seen_refused = 0;
    arm.arm().plant().take_load();
    for (int k = 0; k < 600 && fault == 0; ++k) {
      for (int i = 0; i < 2; ++i) {
        const double at = t + 0.02 * (i + 1) / 2;
        device::Sample sample{.t_us = std::llround(1e6 * at), .valid = true, .deadman = k > 5 && k < 500};
        sample.pose = hand.at(std::max(0.0, at - 0.3));
        arm.arbiter().device().add(sample);
      }
      const cable::ThetaVector true_rate = arm.arm().plant().rate_rad_s();
      const cable::ThetaVector cmd_rate = arm.arm().outputs().theta_rate_rad_s;
      const bool had = true;
      (void)had;
      arm.interval([&](ArmUnderControl& a) {
        const Load load = a.plant().take_load();
        if (load.least_N < least) least = load.least_N, least_at = t;
        contact = std::max(contact, load.contact_N);
        motor = std::min(motor, load.least_motor_N), most = std::max(most, load.most_motor_N);
        for (int c = 0; c < 15; ++c)
          plan_most = std::max(plan_most, a.outputs().tension_plan_N[static_cast<size_t>(c)]);
        const Vec3 now = a.plant().tip_in_base().position_m;
        speed = std::max(speed, norm(subtract(now, tip)) / 0.004);
        tip = now;
        lag = std::max(lag, a.outputs().ik_position_error_m);
        if (trace) {
          double pmin = 1e9, mmin = 1e9;
          for (size_t c = 0; c < 15; ++c)
            pmin = std::min(pmin, a.outputs().tension_plan_N[c]),
            mmin = std::min(mmin, a.outputs().tension_measured_N[c]);
          const auto& g = a.controller().arm().motion().governor;
          if (a.inputs().tick % 10 == 0)
            std::printf(
                "gl %.2f ga %.2f rate %.2f room %.0f %.0f t %.2f plan %.1f meas %.1f least %.1f tip %.3f ik %.4f lim "
                "%x st %d\n",
                g.linear_share, g.angular_share,
                [&] {
                  double m = 0;
                  for (double q : a.outputs().theta_rate_rad_s) m = std::max(m, std::fabs(q));
                  return m * 57.3;
                }(),
                g.room_N[0], g.room_N[1], t, pmin, mmin, load.least_N, a.outputs().tip_speed_m_s,
                a.outputs().ik_position_error_m, a.outputs().limits, (int)a.outputs().state);
        }
      });
      for (; seen_refused < arm.refused().size(); ++seen_refused) {
        ++codes[static_cast<int>(arm.refused()[seen_refused].code)];
        if (trace) std::printf("refused %.2f %s\n", t, arm.refused()[seen_refused].text.c_str());
      }
      for (int q = 0; q < 10; ++q) {
        const auto i = static_cast<size_t>(q);
        const double a = arm.estimate().rate_rad_s[i] - true_rate[i];
        e2 += a * a;
        r2 += true_rate[i] * true_rate[i];
        const double b = cmd_rate[i] - true_rate[i];
        m2 += b * b;
        ++en;
      }
      t += 0.02;
      if (arm.arm().outputs().faults.count > 0) fault = static_cast<int>(arm.arm().outputs().faults.fault[0].number);
    }
    (void)pred_gap;
    (void)window_tip;
    faulted += fault != 0;
    least_all.push_back(least), motor_all.push_back(motor), speed_all.push_back(speed),
        refused_all.push_back(static_cast<double>(arm.refused().size()));
    std::printf(
        "%d %-12s %-10s fault %d at %.2f least %.1f (%.2f) motor %.1f most %.0f plan %.0f tip %.3f ik %.4f contact "
        "%.1f refused",
        seed, poses[seed % 5], hand.name().c_str(), fault, t, least, least_at, motor, most, plan_most, speed, lag,
        contact);
    for (const auto& [code, n] : codes) std::printf(" %d:%d", code, n);
    std::printf(" | rate rms %.3f est err %.3f swing %.3f deg/s\n", std::sqrt(r2 / en) * 57.3,
                std::sqrt(e2 / en) * 57.3, std::sqrt(m2 / en) * 57.3);
    std::fflush(stdout);
  }
  const auto sorted = [](std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v;
  };
  const auto l = sorted(least_all), m = sorted(motor_all), s = sorted(speed_all), r = sorted(refused_all);
  const std::size_t n = l.size();
  std::printf(
      "SUM n %zu faults %d least min %.1f p10 %.1f med %.1f | motor min %.1f p10 %.1f med %.1f | tip p50 %.3f p90 %.3f "
      "max %.3f | refused p50 %.0f p90 %.0f max %.0f\n",
      n, faulted, l[0], l[n / 10], l[n / 2], m[0], m[n / 10], m[n / 2], s[n / 2], s[n * 9 / 10], s[n - 1], r[n / 2],
      r[n * 9 / 10], r[n - 1]);
}
