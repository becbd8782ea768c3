#include "tests/serial/push_run.hpp"

#include <algorithm>

namespace liana::test {

namespace {

constexpr double kTouch_N = 0.5;
constexpr double kLight_N = 5.0;

}  // namespace

double given_N(const serial::Outputs& out) { return norm(out.push.given.force_N); }

PushRun run_push(ForceRig& rig, serial::InsertLaw law, double most_s) {
  rig.enable();
  rig.ask(rig.push(30.0, law));
  PushRun run;
  const double began_s = rig.time_s();
  double touched_s = -1.0;
  int since_message = -1;
  while (rig.time_s() < began_s + most_s) {
    const serial::Outputs& out = rig.tick();
    run.peak_N = std::max(run.peak_N, rig.axial_N());
    run.peak_Nm = std::max(run.peak_Nm, rig.max_gear_Nm());
    run.base_m = std::max(run.base_m, rig.base_moved_m());
    run.faults = out.faults.count;
    run.end = out.push.end;
    if (touched_s < 0.0 && rig.axial_N() > kTouch_N) touched_s = rig.time_s();
    if (out.push.captured != 0) ++since_message;
    if (out.push.end != serial::InsertResult::kCaptured) continue;
    if (run.captured_s < 0.0) {
      run.captured_s = rig.time_s() - began_s;
      run.resisted_N = rig.axial_N();
      run.unload_ticks = since_message;
    }
    run.set_after_N = std::max(run.set_after_N, out.push.set_N);
    if (rig.time_s() < began_s + run.captured_s + 1.0) run.after_1s_N = given_N(out);
    if (rig.axial_N() > kLight_N) run.loaded_s = rig.time_s() - touched_s;
  }
  return run;
}

}  // namespace liana::test
