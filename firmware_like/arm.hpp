// What a type has to offer to be an arm that the Controller moves. Adding one: docs/explanation/architecture.md.
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/controller_io.hpp"
#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/gate.hpp"
#include "firmware_like/safety/supervisor.hpp"

namespace liana {

// A robot's table as the skeleton and the host need it.
template <class T>
concept ArmTable = std::is_trivially_copyable_v<T> && requires(const T& table) {
  { table.drive_count() } -> std::same_as<std::int32_t>;
  { table.tick_s } -> std::convertible_to<double>;                // control period
  { table.interval_ticks } -> std::convertible_to<std::int32_t>;  // T_c in ticks
};

// An arm: a trivially copyable value without heap, virtuals or exceptions, whose functions run once per tick in the
// order listed here. It never sees a bus or a controlword, and what it proposes reaches a drive only through the gate.
template <class A>
concept Arm = std::is_trivially_copyable_v<A> && ArmTable<typename A::Table> &&
    std::is_trivially_copyable_v<typename A::Report> && std::is_trivially_copyable_v<typename A::Sensors> &&
    std::is_constructible_v<A, const typename A::Table&> &&
    requires(A arm, const A& seen, const typename A::Table& table, const typename A::Setpoint& setpoint,
             const typename A::Report& report, typename A::Report& told, const typename A::Sensors& sensors,
             typename A::Sensors& next, const DriveFeedbacks& feedback, const DriveCommands& sent,
             DriveProposals& proposals, const Orders& orders, WatchScope scope, Watch& out, FaultList& faults,
             std::int32_t drive, std::uint64_t tick, bool flag, Request request) {
  { setpoint.kind } -> std::convertible_to<CommandKind>;
  // Once: the table again, and what the drives may be told, in their units.
  { seen.table() } -> std::same_as<const typename A::Table&>;
  { seen.gate_limits() } -> std::same_as<GateLimits>;
  { seen.link_limits() } -> std::same_as<LinkLimits>;
  // 1. What the drives and sensors say about the arm.
  { arm.read(feedback, sensors) } -> std::same_as<void>;
  // 2. What is wrong with it: drive by drive (flag: the drive follows its target), then as a whole.
  { arm.watch_drive(scope, flag, drive, out) } -> std::same_as<void>;
  { arm.watch(scope, tick, faults) } -> std::same_as<void>;
  // True while this drive may be far behind its target because the arm has let it go.
  { seen.lets_go(drive) } -> std::same_as<bool>;
  { seen.status() } -> std::same_as<ArmStatus>;
  // What an operator asks for, before the faults of this tick are judged (called when there is a request only).
  { arm.answer(request, faults) } -> std::same_as<void>;
  // 3. A setpoint that comes into force, or nothing any more: stop along the path.
  { seen.accepts(setpoint) } -> std::same_as<bool>;
  { arm.take(setpoint) } -> std::same_as<void>;
  { arm.brake() } -> std::same_as<void>;
  { seen.is_braking() } -> std::same_as<bool>;
  // 4. Motion: stand where the brakes hold the arm, or advance by a tick (flag: telecommands may move it). LimitBits
  // that acted.
  { arm.stand() } -> std::same_as<void>;
  { arm.advance(flag) } -> std::same_as<std::uint32_t>;
  // 5. What each drive should do, in every phase (flag: no fault is latched). LimitBits that acted.
  { arm.propose(orders, sent, flag, proposals) } -> std::same_as<std::uint32_t>;
  // 6. What the world may know.
  { seen.report(told) } -> std::same_as<void>;
  // The twin's nominal plant: torque that a drive which goes where it is told shows after this report.
  { A::planned_permille(table, report, drive) } -> std::same_as<std::int16_t>;
  // Whether the drives follow torques; and the sensors of the next tick, when nothing happens to them.
  { A::is_torque_controlled(table) } -> std::same_as<bool>;
  { A::predict_sensors(table, report, next) } -> std::same_as<void>;
};

}  // namespace liana
