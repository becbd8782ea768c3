#include "host/drives/canopen/boot_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/drives/canopen/cob_id.hpp"

namespace liana::canopen {
namespace {

using config::Presence;

constexpr std::uint32_t kDisabled = 0x80000000;           // COB-ID bit 31
constexpr std::uint32_t kNoRemoteRequest = 0x40000000;    // COB-ID bit 30: the drive's own business
constexpr std::uint32_t kDeviceProfileMask = 0x0000FFFF;  // of 1000: the profile number
constexpr std::uint32_t kPolarityMask = 0xC0;             // of 607E: position and velocity
constexpr std::uint32_t kProfile402 = 402;
constexpr std::uint32_t kModeCsp = 8;
constexpr std::uint32_t kModeCst = 10;
constexpr std::uint32_t kSupportsCsp = 0x80;   // 6502: bit mode - 1
constexpr std::uint32_t kSupportsCst = 0x200;  // the same
constexpr std::uint32_t kEverySync = 1;
constexpr std::uint16_t kMaxPdos = 32;   // of each direction; drives have 4 to 16
constexpr std::uint16_t kUsualPdos = 4;  // among these there may be gaps
constexpr double kSecondsPerMinute = 60.0;

// Of an object named as axis 1 has it: `axis`, or 0 where it is the whole node's.
std::uint8_t axis_of(std::uint16_t index, std::uint8_t axis) {
  return on_axis(index, 2) == index ? std::uint8_t{0} : axis;
}

// A limit in the drive's 32 bits, rounded to the strict side.
std::uint32_t rounded_up(double value) {
  return value >= 4294967295.0 ? 0xFFFFFFFF : static_cast<std::uint32_t>(std::ceil(std::max(value, 0.0)));
}

std::uint32_t signed_bits(double value) {
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::lround(std::clamp(value, -2147483648.0, 2147483647.0))));
}

// "TPDO2" for 0x1801.
std::string pdo_name(std::uint16_t communication) {
  const bool receive = communication < 0x1800;
  return (receive ? "RPDO" : "TPDO") + std::to_string(communication - (receive ? 0x1400 : 0x1800) + 1);
}

bool same_ratio(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return b != 0 && std::uint64_t{a} * d == std::uint64_t{c} * b;
}

bool leaves_room(std::uint32_t low, std::uint32_t high, std::uint32_t least, std::uint32_t most) {
  if (low == 0 && high == 0) return true;
  return static_cast<std::int32_t>(low) <= static_cast<std::int32_t>(least) &&
         static_cast<std::int32_t>(high) >= static_cast<std::int32_t>(most);
}

// The period with the exponent that the type fixes, where it can be said so.
config::InterpolationPeriod period_of(config::InterpolationPeriod period, const config::ObjectRule& exponent) {
  if (!exponent.value) return period;
  const auto fixed = static_cast<std::int8_t>(*exponent.value);
  double value = period.value * std::pow(10.0, period.exponent - fixed);
  value = std::round(value * 1e6) / 1e6;
  if (value != std::round(value) || value < 1.0 || value > 255.0) return period;
  return {static_cast<std::uint8_t>(value), fixed};
}

}  // namespace

BootPlan::BootPlan(std::span<const ExpectedDrive> axes)
    : type_(axes.front().type), rpdo_deadline_ms_(axes.front().rpdo_deadline_ms) {
  axis_ = axes.front().axis;
  check_identity(axes.front());
  for (const ExpectedDrive& axis : axes) {
    axis_ = axis.axis;
    configure(axis, axis_ == axes.front().axis);
  }
  set_heartbeats(axes.front());
  for (const ExpectedDrive& axis : axes) {
    axis_ = axis.axis;
    check_mode();
  }
}

void BootPlan::configure(const ExpectedDrive& drive, bool is_first) {
  constexpr std::array<std::uint32_t, 2> kTargets{0x60400010, 0x607A0020};
  constexpr std::array<std::uint32_t, 3> kTorqueTargets{0x60400010, 0x60710010, 0x60B10020};
  constexpr std::array<std::uint32_t, 3> kReports{0x60410010, 0x60640020, 0x60770010};
  constexpr std::array<std::uint32_t, 1> kRates{0x606C0020};
  check_mechanics(drive);
  if (type_.is_cst) {
    map_pdo(0x1400, drive.command_id(), kTorqueTargets);
  } else {
    map_pdo(0x1400, drive.command_id(), kTargets);
  }
  map_pdo(0x1800, drive.report_id(), std::span(kReports).first(type_.has_torque ? 3 : 2));
  if (type_.is_cst) map_pdo(0x1801, drive.rate_id(), kRates);
  disable_other_pdos();
  start_up_writes(is_first);
  set_motion(drive);
  check_limits(drive);
}

// Nothing for an object that the type does not have; what the type fixes is read, and compared with its value. Types
// and callers name an object as axis 1 has it.
BootObject* BootPlan::add(BootObject object) {
  const config::ObjectRule rule = type_.rule_of({object.index, object.sub});
  if (rule.presence == Presence::kAbsent) return nullptr;
  if (rule.presence == Presence::kFixed) {
    object.write = false;
    object.keep = 0;
    object.rule = BootRule::kEqual;
    object.mask = all_bits(object.bytes);
    object.value = *rule.value & object.mask;
  }
  object.may_be_missing = object.may_be_missing || rule.presence == Presence::kOptional;
  object.axis = axis_of(object.index, axis_);
  object.index = on_axis(object.index, axis_);
  objects_.push_back(std::move(object));
  return &objects_.back();
}

BootObject* BootPlan::expect(std::uint16_t index, std::uint8_t sub, std::uint32_t value, const char* name,
                             std::uint32_t mask) {
  BootObject object;
  object.index = index;
  object.sub = sub;
  object.value = value & mask;
  object.mask = mask;
  object.name = name;
  return add(std::move(object));
}

// Sub-index 1 takes any number: the second one judges the ratio of both. Where there is only one, it is compared.
void BootPlan::expect_factor(std::uint16_t index, const config::Factor& factor, const char* first, const char* second) {
  BootObject* one = expect(index, 1, factor.first, first);
  const bool pair = one != nullptr && type_.rule_of({index, 2}).presence != Presence::kAbsent &&
                    type_.rule_of({index, 1}).presence != Presence::kFixed;
  if (pair) one->mask = 0;
  BootObject* two = expect(index, 2, factor.second, second);
  if (!pair || two == nullptr || type_.rule_of({index, 2}).presence == Presence::kFixed) return;
  two->rule = BootRule::kPair;
  two->before = factor.first;
}

void BootPlan::expect_at_least(std::uint16_t index, double value, const char* name) {
  BootObject* object = expect(index, 0, rounded_up(value), name);
  if (object != nullptr && type_.rule_of({index, 0}).presence != Presence::kFixed) object->rule = BootRule::kAtLeast;
}

BootObject* BootPlan::write(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value,
                            const char* name) {
  BootObject object;
  object.index = index;
  object.sub = sub;
  object.bytes = bytes;
  object.write = true;
  object.mask = all_bits(bytes);
  object.value = value & object.mask;
  object.name = name;
  return add(std::move(object));
}

void BootPlan::check_identity(const ExpectedDrive& drive) {
  expect(0x1000, 0, kProfile402, "device profile", kDeviceProfileMask);
  expect(0x1018, 1, type_.vendor.value_or(drive.vendor), "vendor id");
  expect(0x1018, 2, type_.product.value_or(drive.product), "product code");
  expect(0x1018, 3, type_.revision.value_or(drive.revision), "revision number");
  serial_ = drive.serial.value_or(0);
  serial_at_ = objects_.size();
  if (BootObject* serial = expect(0x1018, 4, serial_, "serial number", drive.serial ? 0xFFFFFFFF : 0))
    serial->may_be_missing = !drive.serial;
  identity_end_ = objects_.size();
}

void BootPlan::keep(std::size_t at, std::uint32_t found) noexcept {
  if (at != serial_at_ || at >= identity_end_ || objects_[at].mask != 0) return;
  serial_ = objects_[at].value = found;
  objects_[at].mask = 0xFFFFFFFF;
  objects_[at].may_be_missing = false;
}

// What decides how far and which way the motor turns for a count, and what a permille of torque is. Units come first:
// all that follows is in them.
void BootPlan::check_mechanics(const ExpectedDrive& drive) {
  const config::DriveUnits& units = type_.units;
  const config::Factor gear = units.gear.value_or(config::Factor{drive.gear_motor_turns, drive.gear_drum_turns});
  if (type_.is_cst) {
    expect(0x6502, 0, kSupportsCst, "supported drive modes, cst", kSupportsCst);
  } else {
    expect(0x6502, 0, kSupportsCsp, "supported drive modes, csp", kSupportsCsp);
  }
  write(0x60A8, 0, 4, units.position, "unit of positions");
  if (units.velocity) expect(0x60A9, 0, *units.velocity, "unit of speeds");
  expect_factor(0x608F, units.encoder.value_or(config::Factor{drive.counts_per_turn, 1}), "encoder counts",
                "encoder motor revolutions");
  const std::size_t gear_at = objects_.size();
  expect_factor(0x6091, gear, "gear, motor revolutions", "gear, shaft revolutions");
  // A drive that knows no gear has none.
  for (std::size_t i = gear_at; i < objects_.size() && gear.first != gear.second; ++i)
    objects_[i].may_be_missing = false;
  expect_factor(0x6092, units.feed.value_or(config::Factor{drive.counts_per_turn * gear.first, gear.second}),
                "feed, increments", "feed, shaft revolutions");
  const double rated_torque_Nm = drive.rated_torque_mNm / 1000.0;
  expect(0x6076, 0, static_cast<std::uint32_t>(std::lround(rated_torque_Nm * units.rated_torque_per_Nm)),
         "rated torque");
  expect(0x607E, 0, type_.polarity, "polarity", kPolarityMask);
}

// The order is CiA 301's: a mapping can only be changed while its PDO is disabled and it has no entries.
void BootPlan::map_pdo(std::uint16_t communication, std::uint32_t cob_id, std::span<const std::uint32_t> entries) {
  const bool receive = communication < 0x1800;
  const std::string pdo = pdo_name(on_axis(communication, axis_));
  const std::string cob_name = pdo + " COB-ID";
  const auto cob = [&](std::uint32_t value) {
    BootObject* object = write(communication, 1, 4, value, cob_name.c_str());
    object->keep = kNoRemoteRequest;
    object->mask = ~kNoRemoteRequest;
    return object;
  };
  const std::size_t disabled_at = objects_.size();
  cob(kDisabled | cob_id);
  write_mapping(static_cast<std::uint16_t>(communication + 0x0200), disabled_at, entries);
  const auto while_disabled = [&](BootObject* object) {
    if (object == nullptr) return;
    object->needs_from = disabled_at;
    object->needs_to = disabled_at + 1;
  };
  BootObject* type = write(communication, 2, 1, kEverySync, (pdo + " transmission type").c_str());
  if (type != nullptr && type->write && receive) type->rule = BootRule::kAnyTarget;
  while_disabled(type);
  if (receive) while_disabled(write(communication, 5, 2, rpdo_deadline_ms_, (pdo + " deadline").c_str()));
  const std::size_t enabled_at = objects_.size();
  BootObject* enabled = cob(cob_id);
  enabled->needs_from = disabled_at;
  enabled->needs_to = enabled_at;
}

void BootPlan::write_mapping(std::uint16_t mapping, std::size_t disabled_at, std::span<const std::uint32_t> entries) {
  const auto communication = static_cast<std::uint16_t>(mapping - 0x0200);
  const std::string pdo = pdo_name(on_axis(communication, axis_)) + " mapping ";
  const std::size_t emptied_at = objects_.size();
  const auto put = [&](std::uint8_t sub, std::uint8_t bytes, std::uint32_t value, std::size_t needs_to) {
    BootObject* object = write(mapping, sub, bytes, value, (pdo + (sub == 0 ? "count" : std::to_string(sub))).c_str());
    object->write = !type_.mapping_is_fixed;
    object->needs_from = disabled_at;
    object->needs_to = needs_to;
  };
  if (!type_.mapping_is_fixed) put(0, 1, 0, emptied_at);
  const std::size_t entries_at = objects_.size();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::uint32_t mapped = on_axis(static_cast<std::uint16_t>(entries[i] >> 16), axis_);
    put(static_cast<std::uint8_t>(i + 1), 4, mapped << 16 | (entries[i] & 0xFFFF), entries_at);
  }
  put(0, 1, static_cast<std::uint32_t>(entries.size()), objects_.size());
}

// Whatever COB-ID they have, and however many there are.
void BootPlan::disable_other_pdos() {
  for (const int page : {0x1400, 0x1800}) {
    for (std::uint16_t number = page == 0x1800 && type_.is_cst ? 2 : 1; number < kMaxPdos; ++number) {
      const char* const name =
          page == 0x1400 ? "COB-ID of an RPDO that is not used" : "COB-ID of a TPDO that is not used";
      BootObject* object = write(static_cast<std::uint16_t>(page + number), 1, 4, kDisabled, name);
      object->mask = kDisabled;
      object->keep = ~kDisabled;
      object->may_be_missing = true;
      object->ends_list_if_missing = number >= kUsualPdos;
    }
  }
}

// Of the first axis also those of the whole node.
void BootPlan::start_up_writes(bool is_first) {
  for (const config::StartUpWrite& each : type_.writes) {
    if (!is_first && axis_of(each.object.index, axis_) == 0) continue;
    BootObject* object = write(each.object.index, each.object.sub, each.bytes, each.value, each.name.c_str());
    object->read_back = each.read_back;
  }
}

void BootPlan::set_motion(const ExpectedDrive& drive) {
  const auto bits = [](std::int16_t value) { return static_cast<std::uint32_t>(static_cast<std::uint16_t>(value)); };
  write(0x6060, 0, 1, type_.is_cst ? kModeCst : kModeCsp, "mode of operation");
  const config::InterpolationPeriod period = period_of(drive.period, type_.rule_of({0x60C2, 2}));
  write(0x60C2, 1, 1, period.value, "interpolation period value");
  write(0x60C2, 2, 1, static_cast<std::uint32_t>(period.exponent), "interpolation period exponent");
  write(0x6072, 0, 2, type_.max_torque_permille, "max torque");
  write(0x6065, 0, 4, drive.following_window_counts, "following error window");
  write(0x6066, 0, 2, type_.following_time_ms, "following error time");
  write(0x605A, 0, 2, bits(type_.quick_stop_option), "quick stop option");
  write(0x605E, 0, 2, bits(type_.fault_option), "fault reaction option");
  write(0x6007, 0, 2, bits(type_.abort_connection_option), "abort connection option");
}

// What would keep the drive from following or from stopping where the arm counts on it.
void BootPlan::check_limits(const ExpectedDrive& drive) {
  const DriveProfile& demand = drive.demand;
  const double rpm = demand.counts_per_s * kSecondsPerMinute / std::max(1U, drive.counts_per_turn);
  const double speed = type_.units.speeds_in_rpm ? rpm : demand.counts_per_s;
  BootObject* low = expect(0x607D, 1, signed_bits(demand.min_counts), "least position");
  const bool pair = low != nullptr && type_.rule_of({0x607D, 1}).presence != Presence::kFixed;
  if (pair) low->mask = 0;
  BootObject* high = expect(0x607D, 2, signed_bits(demand.max_counts), "most position");
  if (pair && high != nullptr && type_.rule_of({0x607D, 2}).presence != Presence::kFixed) {
    high->rule = BootRule::kRange;
    high->before = signed_bits(demand.min_counts);
  }
  expect_at_least(0x607F, speed, "max profile velocity");
  expect_at_least(0x6080, rpm, "max motor speed");
  expect_at_least(0x60C5, speed / type_.stop_within_s, "max acceleration");
  expect_at_least(0x6085, speed / type_.stop_within_s, "quick stop deceleration");
}

void BootPlan::set_heartbeats(const ExpectedDrive& drive) {
  write(0x1017, 0, 2, drive.heartbeat_ms, "producer heartbeat time");
  write(0x1016, 1, 4, (std::uint32_t{kMasterNode} << 16) | drive.master_timeout_ms, "consumer heartbeat time");
}

// Last, so that the drive has had time: what it was told as mode has to be the one that it is in.
void BootPlan::check_mode() {
  const std::uint32_t mode = type_.is_cst ? kModeCst : kModeCsp;
  if (BootObject* shown = expect(kModeDisplay, 0, mode, "mode of operation display", 0xFF)) {
    shown->bytes = 1;
    const auto told = std::find_if(objects_.begin(), objects_.end(), [&](const BootObject& object) {
      return object.index == on_axis(kModeOfOperation, axis_);
    });
    shown->needs_from = static_cast<std::size_t>(told - objects_.begin());
    shown->needs_to = shown->needs_from + 1;
    shown->settles = shown->rule == BootRule::kEqual && shown->value == mode;
  }
}

bool BootPlan::accepts(std::size_t at, std::uint32_t found, std::optional<std::uint32_t> before) const noexcept {
  const BootObject& object = objects_[at];
  switch (object.rule) {
    case BootRule::kEqual:
      return (found & object.mask) == (object.value & object.mask);
    case BootRule::kAtLeast:
      return found >= object.value;
    case BootRule::kAnyTarget:
      return (found & 0xFF) <= 240 || (found & 0xFF) >= 254;
    case BootRule::kPair:
      return !before || same_ratio(*before, found, object.before, object.value);
    case BootRule::kRange:
      return !before || leaves_room(*before, found, object.before, object.value);
  }
  return false;
}

std::uint8_t BootPlan::sub_to_blame(std::size_t at, std::uint32_t found) const noexcept {
  const BootObject& object = objects_[at];
  const bool second_is_right =
      (object.rule == BootRule::kPair && found == object.value) ||
      (object.rule == BootRule::kRange && static_cast<std::int32_t>(found) >= static_cast<std::int32_t>(object.value));
  return static_cast<std::uint8_t>(object.sub - (second_is_right ? 1 : 0));
}

}  // namespace liana::canopen
