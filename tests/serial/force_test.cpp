#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include "tests/serial/force_rig.hpp"
namespace liana::test {
double env(const char* n, double d) { const char* s = std::getenv(n); return s ? std::atof(s) : d; }
TEST(Scratch, Sweep) {
  int first = (int)env("FIRST", 1), count = (int)env("COUNT", 8);
  int got = 0; double sum = 0, worst = 0, p = 0, g = 0, f1m = 0, f5m=0, basem = 0, lat = 0;
  for (int s = first; s < first + count; ++s) {
  ForceCase c = drawn_case((std::uint64_t)s);
  c.never_captures = env("NEVER", 0) > 0;
  ForceRig rig{c};
  rig.enable();
  auto sp = rig.push(env("FORCE", 30), env("LAW", 0) > 0 ? serial::PushLaw::kImpedance : serial::PushLaw::kForce);
  sp.push.gains[serial::kAxialDamping] = env("KA", sp.push.gains[serial::kAxialDamping]);
  sp.push.gains[serial::kLateralDamping] = env("KL", sp.push.gains[serial::kLateralDamping]);
  sp.push.gains[serial::kTurnDamping] = env("KT", sp.push.gains[serial::kTurnDamping]);
  sp.push.gains[serial::kPushMass] = env("MD", sp.push.gains[serial::kPushMass]);
  sp.push.gains[serial::kUnloadDamping] = env("KU", sp.push.gains[serial::kUnloadDamping]);
  rig.ask(sp);
  double captured_s = 0, began = rig.time_s(), peak_all = 0, gear_all = 0, f1 = -1, f5 = -1, lat_all = 0, base = 0, low = 99, high = -99;
  double at = 0;
  for (int i = 0; i < env("TICKS", 6000); ++i) {
    rig.tick(); const auto& o = rig.out();
    peak_all = std::max(peak_all, rig.axial_N()); gear_all = std::max(gear_all, rig.most_gear_Nm());
    base = std::max(base, rig.base_moved_m());
    lat_all = std::max(lat_all, std::hypot(rig.contact().force_N.x, rig.contact().force_N.y));
    double t = rig.time_s() - began;
    if (o.push.end == serial::PushEnd::kCaptured && captured_s == 0) { captured_s = t; at = rig.axial_N(); }
    const auto& w = o.push.given.force_N;
    double f = std::sqrt(w[0]*w[0]+w[1]*w[1]+w[2]*w[2]);
    if (captured_s > 0 && f1 < 0 && t >= captured_s + 1) f1 = f;
    if (captured_s > 0 && f5 < 0 && t >= captured_s + 5) f5 = f;
    if (t > env("TICKS", 6000)*0.004 - 5) { low = std::min(low, rig.axial_N()); high = std::max(high, rig.axial_N()); }
  }
  const auto& o = rig.out();
  std::printf("seed %d captured %.2f at %.1f peak %.1f lateral %.1f gear %.1f after1 %.1f after5 %.1f base %.1f end %d faults %d last5 %.1f..%.1f\n", s, captured_s, at, peak_all, lat_all, gear_all, f1, f5, 1e3*base, (int)o.push.end, o.faults.count ? (int)o.faults.fault[0].number : 0, low, high);
  if (captured_s > 0) { got++; sum += captured_s; worst = std::max(worst, captured_s); f1m = std::max(f1m, f1); f5m = std::max(f5m, f5);}
  p = std::max(p, peak_all); g = std::max(g, gear_all); basem = std::max(basem, base); lat = std::max(lat, lat_all);
  }
  std::printf("ALL got %d of %d mean %.2f worst %.2f peak %.1f lateral %.1f gear %.1f after1 %.1f after5 %.1f base %.1f\n", got, count, sum/std::max(1,got), worst, p, lat, g, f1m, f5m, 1e3*basem);
}
}
