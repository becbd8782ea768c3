#include "firmware_like/safety/faults.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "firmware_like/math/enumerators.hpp"
#include "firmware_like/safety/fault_causes.hpp"

namespace liana {
namespace {

// Every number that was ever published, with the name that logs, Lua and docs use. Rows are only ever added.
struct Published {
  FaultNumber number;
  std::uint16_t value;
  const char* name;
};
const std::vector<Published> kPublished{
    {FaultNumber::kNone, 0, "none"},
    {FaultNumber::kCommandInvalid, 1001, "command_invalid"},
    {FaultNumber::kTicksLost, 2001, "ticks_lost"},
    {FaultNumber::kJointOutOfRange, 2002, "joint_out_of_range"},
    {FaultNumber::kJointJump, 2003, "joint_jump"},
    {FaultNumber::kWristSensorLost, 2004, "wrist_sensor_lost"},
    {FaultNumber::kPushOverload, 2005, "insert_overload"},
    {FaultNumber::kDriveMissing, 3001, "drive_missing"},
    {FaultNumber::kDriveSilent, 3002, "drive_silent"},
    {FaultNumber::kDriveFault, 3003, "drive_fault"},
    {FaultNumber::kDriveLeftOperation, 3004, "drive_left_operation"},
    {FaultNumber::kDriveEnableTimeout, 3005, "drive_enable_timeout"},
    {FaultNumber::kFollowingError, 3006, "following_error"},
    {FaultNumber::kDriveNotOperational, 3007, "drive_not_operational"},
    {FaultNumber::kDriveStopTimeout, 3008, "drive_stop_timeout"},
    {FaultNumber::kNodeTwice, 3009, "duplicate_node_id"},
    {FaultNumber::kDriveOtherMode, 3010, "drive_other_mode"},
    {FaultNumber::kBusLost, 4001, "bus_lost"},
    {FaultNumber::kCableSlack, 5001, "cable_slack"},
    {FaultNumber::kCableOverload, 5002, "cable_overload"},
    {FaultNumber::kTensionAlarm, 5003, "tension_alarm"},
    {FaultNumber::kHomingImplausible, 5004, "homing_implausible"},
    {FaultNumber::kCableSlip, 5005, "cable_slip"},
    {FaultNumber::kCableBreak, 5006, "cable_break"},
    {FaultNumber::kTensionScatters, 5007, "tension_scatters"},
    {FaultNumber::kBodyContact, 5008, "body_contact"},
    {FaultNumber::kFrictionNotAsDeclared, 5009, "friction_not_as_declared"},
    {FaultNumber::kLoadCellLost, 5010, "load_cell_lost"},
    {FaultNumber::kLoadCellContradicts, 5011, "load_cell_contradicts"},
    {FaultNumber::kGateRefused, 6001, "gate_refused"},
};

TEST(Faults, EveryNumberKeepsItsValueAndItsName) {
  ASSERT_EQ(all_faults().size(), kPublished.size());
  for (std::size_t i = 0; i < kPublished.size(); ++i) {
    EXPECT_EQ(static_cast<std::uint16_t>(kPublished[i].number), kPublished[i].value);
    EXPECT_EQ(all_faults()[i].number, kPublished[i].number);
    EXPECT_STREQ(fault_info(kPublished[i].number).name, kPublished[i].name);
  }
}

TEST(Faults, EveryFaultSaysWhatHappenedWhatToDoAndHowTheArmStops) {
  std::set<std::string> names;
  std::set<std::string> remedies;
  for (const FaultInfo& info : all_faults()) {
    names.insert(info.name);
    remedies.insert(info.remedy);
    EXPECT_EQ(std::string(info.text).back(), '.') << info.name;
    EXPECT_EQ(info.category == StopCategory::kNone, info.number == FaultNumber::kNone) << info.name;
  }
  EXPECT_EQ(names.size(), all_faults().size());
  EXPECT_EQ(remedies.size(), all_faults().size());
}

TEST(Faults, ANumberThatDoesNotExistHasTheEntryOfNone) {
  std::size_t found = 0;
  for (int value = 0; value <= 65535; ++value) {
    const auto number = static_cast<FaultNumber>(value);
    const FaultInfo& info = fault_info(number);
    if (info.number == number) {
      ++found;
    } else {
      ASSERT_EQ(&info, &all_faults().front()) << value;
    }
  }
  EXPECT_EQ(found, all_faults().size());
}

TEST(Faults, EnumeratorsAreCountedAndOtherValuesAreNone) {
  enum class Few : std::uint16_t { kA = 0, kB = 7, kC = 101, kD = 150 };
  static_assert(is_enumerator<Few::kB>() && !is_enumerator<static_cast<Few>(8)>());
  static_assert(count_enumerators<Few, 100>() == 4 && count_enumerators<Few, 1000>() == 2);
  static_assert(count_enumerators<FaultNumber, 1000>() == 30);
}

TEST(Faults, TheSameNumberAndIndexIsLatchedOnceAndKeepsItsFirstTick) {
  FaultList faults{};
  EXPECT_TRUE(latch(faults, {FaultNumber::kDriveSilent, 3, 0, 10}));
  EXPECT_FALSE(latch(faults, {FaultNumber::kDriveSilent, 3, 0, 11}));
  EXPECT_TRUE(latch(faults, {FaultNumber::kDriveSilent, 4, 0, 11}));
  EXPECT_TRUE(latch(faults, {FaultNumber::kDriveMissing, 3, 0, 12}));
  EXPECT_EQ(faults.count, 3);
  EXPECT_EQ(faults.dropped, 0U);
  EXPECT_EQ(faults.fault[0].tick, 10U);
}

TEST(Faults, ADetailThatComesLaterIsFilledInButNeverOverwritten) {
  FaultList faults{};
  latch(faults, {FaultNumber::kDriveFault, 3, 0, 10});
  latch(faults, {FaultNumber::kDriveFault, 3, 0x8130, 11});
  latch(faults, {FaultNumber::kDriveFault, 3, 0x8250, 12});
  EXPECT_EQ(faults.fault[0].detail, 0x8130);
  EXPECT_EQ(faults.fault[0].tick, 10U);
}

TEST(Faults, AFullListCountsTheRestAndStillRaisesTheStopCategory) {
  FaultList faults{};
  for (std::int16_t i = 0; i < FaultList::kCapacity; ++i)
    EXPECT_TRUE(latch(faults, {FaultNumber::kCableSlack, i, 0, 1}));
  EXPECT_EQ(faults.category, StopCategory::kHold);
  EXPECT_EQ(faults.immediate, 0);
  EXPECT_FALSE(latch(faults, {FaultNumber::kCableOverload, 0, 0, 2}));
  EXPECT_EQ(faults.count, FaultList::kCapacity);
  EXPECT_EQ(faults.dropped, 1U);
  EXPECT_EQ(faults.category, StopCategory::kOff);
  EXPECT_EQ(faults.immediate, 1);
}

TEST(Faults, ALesserFaultThatComesLaterDoesNotLowerTheStopCategory) {
  FaultList faults{};
  latch(faults, {FaultNumber::kDriveSilent, 0, 0, 1});
  latch(faults, {FaultNumber::kCableSlack, 1, 0, 2});
  EXPECT_EQ(faults.category, StopCategory::kStop);
  EXPECT_EQ(faults.immediate, 1);
  faults.dropped = std::numeric_limits<std::uint32_t>::max();
  faults.count = FaultList::kCapacity;
  latch(faults, {FaultNumber::kCableOverload, 0, 0, 3});
  EXPECT_EQ(faults.dropped, std::numeric_limits<std::uint32_t>::max()) << "never none again";
}

TEST(Faults, ARetractNeedsEveryLatchedFaultToAllowItAndNoneThatIsUnknown) {
  FaultList faults{};
  EXPECT_TRUE(allow_retract(faults));
  for (std::int16_t i = 0; i < FaultList::kCapacity; ++i) latch(faults, {FaultNumber::kCableSlack, i, 0, 1});
  EXPECT_TRUE(allow_retract(faults));
  FaultList with_break = faults;
  with_break.count = 3;
  latch(with_break, {FaultNumber::kCableBreak, 4, 0, 2});
  EXPECT_FALSE(allow_retract(with_break));
  latch(faults, {FaultNumber::kCommandInvalid, -1, 0, 2});
  EXPECT_EQ(faults.dropped, 1U);
  EXPECT_FALSE(allow_retract(faults));
}

// Every fault that forbids it also stops today: each condition has to hold by itself all the same.
TEST(Faults, ARetractIsForbiddenByTheCategoryAloneAndByAnyFaultAlone) {
  for (const FaultNumber last : {FaultNumber::kCableSlack, FaultNumber::kCableBreak}) {
    FaultList faults{};
    latch(faults, {last == FaultNumber::kCableSlack ? FaultNumber::kCableBreak : FaultNumber::kCableSlack, 0, 0, 1});
    latch(faults, {last, 1, 0, 1});
    faults.category = StopCategory::kHold;
    EXPECT_FALSE(allow_retract(faults)) << static_cast<int>(last);
  }
  FaultList faults{};
  latch(faults, {FaultNumber::kCableSlack, 0, 0, 1});
  EXPECT_TRUE(allow_retract(faults));
  faults.category = StopCategory::kStop;
  EXPECT_FALSE(allow_retract(faults));
}

TEST(Faults, NoFaultIsNeverLatched) {
  FaultList faults{};
  EXPECT_FALSE(latch(faults, Fault{}));
  EXPECT_EQ(faults.count, 0);
}

TEST(FaultCauses, ALostDriveIsTheCauseOfWhatMissesItAndOfNothingElse) {
  FaultList list;
  latch(list, {FaultNumber::kDriveSilent, 3, 0, 100});
  latch(list, {FaultNumber::kDriveMissing, 3, 0, 190});
  latch(list, {FaultNumber::kDriveMissing, 4, 0, 190});
  latch(list, {FaultNumber::kDriveStopTimeout, 3, 0, 400});
  EXPECT_EQ(cause_of(list, 0), std::nullopt);
  EXPECT_EQ(cause_of(list, 1), 0);
  EXPECT_EQ(cause_of(list, 2), std::nullopt) << "another drive";
  EXPECT_EQ(cause_of(list, 3), 0);
  latch(list, {FaultNumber::kDriveLeftOperation, 4, 0, 401});
  latch(list, {FaultNumber::kFollowingError, 4, 0, 402});
  EXPECT_EQ(cause_of(list, 5), 4) << "the cause is not the first of the list";
}

TEST(FaultCauses, AConsequenceIsNotOlderThanItsCause) {
  const Fault broken{FaultNumber::kCableBreak, 4, 0, 100};
  EXPECT_FALSE(is_consequence(broken, {FaultNumber::kCableSlack, 5, 0, 99}));
  EXPECT_TRUE(is_consequence(broken, {FaultNumber::kCableSlack, 5, 0, 100}));
  EXPECT_FALSE(is_consequence(broken, {FaultNumber::kCableBreak, 5, 0, 101})) << "a second break is a cause itself";
}

TEST(FaultCauses, NoFaultFollowsFromItself) {
  for (const FaultInfo& info : all_faults())
    EXPECT_FALSE(is_consequence({info.number, 0, 0, 1}, {info.number, 0, 0, 1})) << info.name;
}

}  // namespace
}  // namespace liana
