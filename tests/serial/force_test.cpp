#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include "tests/serial/force_rig.hpp"
namespace liana::test {
TEST(Scratch, Push) {
  ForceRig rig{ForceCase{}};
  rig.enable();
  rig.ask(rig.push(30.0));
  const char* fine = std::getenv("FINE");
  double captured_s = 0, began = rig.time_s(), peak_all = 0, gear_all = 0;
  for (int i = 0; i < (fine ? 1500 : 4000); ++i) {
    rig.tick(); const auto& o = rig.out();
    peak_all = std::max(peak_all, rig.axial_N()); gear_all = std::max(gear_all, rig.most_gear_Nm());
    if (o.push.end == serial::PushEnd::kCaptured && captured_s == 0) captured_s = rig.time_s() - began;
    if (fine ? (i > 1200 && i % 2 == 0) : i % 100 == 0)
    std::printf("%6.2f phase %d end %d set %5.1f given %7.2f %7.2f %7.2f  %7.2f %7.2f %7.2f axial %7.2f depth %7.2f trav %7.2f gear %6.1f base %5.1f\n", rig.time_s(), (int)o.push.phase, (int)o.push.end, o.push.set_N,
      o.push.given.force_N[0], o.push.given.force_N[1], o.push.given.force_N[2], o.push.given.torque_Nm[0], o.push.given.torque_Nm[1], o.push.given.torque_Nm[2], rig.axial_N(), 1e3*rig.plate().pose.position_m.z, 1e3*o.push.travel_m, rig.most_gear_Nm(), 1e3*rig.base_moved_m());
  }
  std::printf("captured after %.2f peak %.1f gear %.1f faults %d\n", captured_s, peak_all, gear_all, rig.out().faults.count);
}
}
