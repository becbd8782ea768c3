#include "host/storage/recording/image.hpp"

#include <algorithm>
#include <tuple>

#include "host/storage/recording/image_reader.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

// What no type alone can say. Each is found by ImageReader when it has read such a structure.

void check(const ImageReader& in, const FaultList& list) {
  in.require("count", list.count, 0, FaultList::kCapacity);
  in.require("immediate", list.immediate, 0, 1);
}

void check(const ImageReader& in, const Fault& fault) { in.require("index", fault.index, -1, kMaxDrives - 1); }

void check(const ImageReader& in, const DriveLinkMonitorState& state) {
  in.require_mask("seen_mask", state.seen_mask, in.bounds().drives);
}

void check(const ImageReader& in, const cable::NodeTarget& target) {
  in.require("node", target.node, 0, in.bounds().segments);
}

void check(const ImageReader& in, const cable::Setpoint& setpoint) {
  in.require_mask("held_mask", setpoint.held_mask, in.bounds().joints);
}

void check(const ImageReader& in, const cable::HeldBounds& held) {
  in.require_mask("low", held.low, in.bounds().joints);
  in.require_mask("high", held.high, in.bounds().joints);
}

void check(const ImageReader& in, const cable::ShapeState& state) {
  const std::int64_t pulls = cable::kMaxNodeTargets + cable::kMaxKeepClear * in.bounds().segments;
  in.require("next_pull", static_cast<std::int64_t>(std::min<std::uint64_t>(state.next_pull, INT64_MAX)), 0, pulls);
  in.require("tick", state.tick, 0, cable::kShapeTicks - 1);
  in.require_mask("held_mask", state.held_mask, in.bounds().joints);
}

void check(const ImageReader& in, const cable::IkResult& ik) {
  in.require_mask("limit_mask", ik.limit_mask, in.bounds().joints);
}

void check(const ImageReader& in, const cable::MotionState& motion) {
  in.require("interval_tick", motion.interval_tick, 0, in.bounds().interval_ticks);
  in.require_mask("held_mask", motion.held_mask, in.bounds().joints);
}

void check(const ImageReader& in, const cable::CableMonitorState& state) {
  in.require("newest", state.newest, 0, 1);
  in.require("segment", state.segment, 0, in.bounds().segments - 1);
  const std::int32_t first = in.bounds().first_cable[static_cast<std::size_t>(state.segment)];
  in.require("cable", state.cable, first, first);
  in.require("suspect", state.suspect, -1, in.bounds().drives - 1);
}

void check(const ImageReader& in, const cable::SegmentReleaseState& state) {
  in.require("segment", state.segment, -1, in.bounds().segments - 1);
  in.require("cable", state.cable, 0, in.bounds().drives - 1);
}

void check(const ImageReader& in, const cable::FrictionEstimatorState& state) {
  in.require("axis", state.axis, 0, in.bounds().joints - 1);
}

void check(const ImageReader& in, const cable::ContactDetectorState& state) {
  in.require("segment", state.segment, -1, in.bounds().segments - 1);
  in.require("best_place", state.best_place, -1, static_cast<std::int64_t>(cable::kPlaces) * in.bounds().segments - 1);
}

// Of tables far wider than any: the core counts seconds and minutes in ticks.
void check_tick(const ImageReader& in, double tick_s) {
  if (!(tick_s >= 1e-5 && tick_s <= 10.0)) in.refuse("tick_s", std::to_string(tick_s), "0.00001..10");
}

void check(const ImageReader& in, const cable::RobotParams& table) {
  in.require("segment_count", table.segment_count, 1, cable::kMaxSegments);
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m) {
    const bool is_base = m == 0 && cable::feeds(table.segment[m]);
    if (m > 0 && cable::feeds(table.segment[m]))
      in.refuse("segment.slide_m_rad", std::to_string(table.segment[m].slide_m_rad), "0 but in the first segment");
    in.require("segment.modules", table.segment[m].modules, is_base ? 0 : 1, cable::kMaxModules);
    in.require("segment.cables", table.segment[m].cables, is_base ? 2 : 3, is_base ? 2 : cable::kMaxSegmentCables);
  }
  in.require("interval_ticks", table.interval_ticks, 1, 100000);
  check_tick(in, table.tick_s);
}

void check(const ImageReader& in, const serial::IkResult& ik) {
  in.require_mask("limit_mask", ik.limit_mask, in.bounds().joints);
}

void check(const ImageReader& in, const serial::MotionState& motion) {
  in.require("interval_tick", motion.interval_tick, 0, in.bounds().interval_ticks);
}

void check(const ImageReader& in, const serial::InsertState& push) {
  in.require("overload_joint", push.overload_joint, -1, in.bounds().joints - 1);
}

void check(const ImageReader& in, const serial::RobotParams& table) {
  in.require("joint_count", table.joint_count, 6, serial::kMaxJoints);
  in.require("interval_ticks", table.interval_ticks, 1, 100000);
  check_tick(in, table.tick_s);
}

namespace {

StateBounds bounds_of(const serial::RobotParams& table) {
  return {table.drive_count(), 0, table.joint_count, table.interval_ticks, {}};
}

StateBounds bounds_of(const cable::RobotParams& table) {
  StateBounds bounds{table.drive_count(), table.segment_count, table.theta_count(), table.interval_ticks, {}};
  static_assert(cable::kMaxSegments <= std::tuple_size_v<decltype(bounds.first_cable)>);
  for (std::size_t m = 0; m + 1 < static_cast<std::size_t>(table.segment_count); ++m)
    bounds.first_cable[m + 1] = bounds.first_cable[m] + table.segment[m].cables;
  return bounds;
}

}  // namespace

template <class Arm>
void append_state(std::string& out, const Controller<Arm>& controller) {
  Writer writer(out);
  visit(writer, controller);
}

template <class Arm>
Controller<Arm> controller_from(std::string_view state, const typename Arm::Table& table, const std::string& source) {
  ImageReader reader(state, source, bounds_of(table));
  Controller<Arm> controller(table);
  reader("controller", controller);
  reader.require_end();
  return controller;
}

template <class Table>
Table checked_table(std::string_view bytes, const std::string& source, std::size_t& used) {
  ImageReader reader(bytes, source, {});
  Table table;
  reader("table", table);
  used = reader.position();
  return table;
}

#define LIANA_IMAGES(Arm)                                                                                 \
  template void append_state(std::string&, const Controller<Arm>&);                                       \
  template Controller<Arm> controller_from<Arm>(std::string_view, const Arm::Table&, const std::string&); \
  template Arm::Table checked_table<Arm::Table>(std::string_view, const std::string&, std::size_t&);
LIANA_IMAGES(cable::CableArm)
LIANA_IMAGES(serial::SerialArm)
#undef LIANA_IMAGES

}  // namespace liana::recording
