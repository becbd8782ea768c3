#include "firmware_like/serial/report.hpp"

namespace liana::serial {

InsertStatus push_report(const InsertState& push, const WristState& wrist, const AdapterState& adapter) noexcept {
  InsertStatus out;
  out.number = push.order.number;
  out.phase = push.phase;
  out.end = push.end;
  out.law = push.order.law;
  out.wrist = health(wrist);
  out.touched = has_touched(push) ? 1 : 0;
  out.set_N = push.set_N;
  out.travel_m = push.travel_m;
  out.aside_m = push.aside_m;
  out.felt = wrist.felt;
  out.given = given_by_arm(wrist);
  out.wrist_age_ticks = wrist.age_ticks;
  out.adapter_age_ticks = adapter.age_ticks;
  out.adapter_sequence = adapter.last.sequence;
  out.captured = adapter.last.captured;
  out.latch = adapter.last.latch;
  out.lock = adapter.last.lock;
  out.depth_01mm = adapter.last.depth_01mm;
  return out;
}

}  // namespace liana::serial
