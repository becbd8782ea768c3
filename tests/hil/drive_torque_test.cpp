// A drive in cyclic synchronous torque, with an elastic joint behind it: force, damping, and every way to rest.
#include <cmath>

#include "drive_harness.hpp"

namespace liana::bench {
namespace {

constexpr double kRadPerCount = 2.0 * 3.14159265358979323846 / 1048576.0;
constexpr double kRated_Nm = 150.0;

// Rotor, gear and link of one joint; the link turns freely, or stands against a wall that is a spring.
struct ElasticJoint {
  double rotor_rad = 0.0, rotor_rate = 0.0, link_rad = 0.0, link_rate = 0.0;
  double wall_Nm_rad = 0.0, link_kgm2 = 400.0;

  double gear_Nm() const { return 8e4 * (rotor_rad - link_rad) + 60.0 * (rotor_rate - link_rate); }
  void step(double step_s, double motor_Nm) {
    const double gear = gear_Nm();
    rotor_rate += step_s * (motor_Nm - gear) / 10.0;
    link_rate += step_s * (gear - wall_Nm_rad * link_rad - 40.0 * link_rate) / link_kgm2;
    rotor_rad += step_s * rotor_rate;
    link_rad += step_s * link_rate;
  }
};

class TorqueDrive : public DriveHarness {
 protected:
  static DriveSettings torque_settings() {
    DriveSettings with = settings();
    with.counts_per_turn = 1048576;
    with.rated_torque_mNm = 150000;
    with.is_torque_controlled = true;
    return with;
  }

  TorqueDrive() : DriveHarness(torque_settings()) {
    boot();
    configure(12, {0x60400010, 0x60710010, 0x60B10020}, 10);
  }

  void ask(int controlword, int permille, std::int32_t counts_per_s = 0) {
    std::vector<std::uint8_t> bytes(8);
    put_little_endian(&bytes[0], 2, static_cast<std::uint64_t>(controlword));
    put_little_endian(&bytes[2], 2, static_cast<std::uint64_t>(permille));
    put_little_endian(&bytes[4], 4, static_cast<std::uint64_t>(counts_per_s));
    give(0x200 + kNode, bytes);
  }

  // One period of 4 ms: SYNC, physics with the loop once a millisecond, then the next command if there is one.
  FrameList period(std::optional<int> controlword, int permille = 0, std::int32_t counts_per_s = 0) {
    now_us_ += kPeriod_us;
    FrameList out = give(0x080, {});
    const FrameList later = tick();
    out.insert(out.end(), later.begin(), later.end());
    for (int i = 0; i < 4; ++i) {
      const bool free = drive_.is_torque_controlled();
      const double motor = free ? drive_.torque_Nm(0.001, joint_.gear_Nm(), 1000.0 + joint_.rotor_rad / kRadPerCount,
                                                   joint_.rotor_rate / kRadPerCount)
                                : 0.0;
      if (!free) drive_.move(0.001, 0.0);
      for (int k = 0; k < 20; ++k) {
        joint_.step(0.00005, motor);
        if (free) continue;
        joint_.rotor_rad = (drive_.motor().position_counts() - 1000.0) * kRadPerCount;
        joint_.rotor_rate = 0.0;
      }
      max_Nm_ = std::max(max_Nm_, std::fabs(motor));
    }
    drive_.set_measured(1000.0 * joint_.gear_Nm() / kRated_Nm);
    if (controlword) ask(*controlword, permille, counts_per_s);
    return out;
  }
  void run(int periods, int permille, std::int32_t counts_per_s = 0) {
    for (int i = 0; i < periods; ++i) {
      if (i % 20 == 0) give(0x77F, {0x05});
      period(0x0F, permille, counts_per_s);
    }
  }
  void enable_torque() {
    give(0x77F, {0x05});
    for (const int controlword : {0x06, 0x07, 0x0F, 0x0F}) period(controlword);
    ASSERT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
    ASSERT_TRUE(drive_.is_torque_controlled());
  }
  // Periods until the drive has power no more; the master says nothing but its heartbeat and, if any, the controlword.
  int until_braked(std::optional<int> controlword) {
    for (int i = 0; i < 3000; ++i) {
      if (!drive_.is_torque_controlled()) return i;
      if (i % 20 == 0) give(0x77F, {0x05});
      period(controlword);
    }
    return -1;
  }

  ElasticJoint joint_;
  double max_Nm_ = 0.0;
};

TEST_F(TorqueDrive, SaysThatItHasBothModesAndTakesTorqueWithoutPowerOnly) {
  EXPECT_EQ(read(0x6502, 0), 0x280U);
  EXPECT_EQ(read(0x6061, 0), 10U);
  EXPECT_EQ(write(0x6060, 0, 1, 9), abort_code::kValue);
  EXPECT_EQ(write(0x6060, 0, 1, 8), abort_code::kNone);
  give(0x77F, {0x05});
  for (const int controlword : {0x06, 0x07, 0x0F, 0x0F}) period(controlword);
  ASSERT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
  EXPECT_FALSE(drive_.is_torque_controlled());
  EXPECT_EQ(write(0x6060, 0, 1, 10), abort_code::kDeviceState);
}

TEST_F(TorqueDrive, ADriveWithoutTheSensorHasNoTorqueMode) {
  Drive plain(settings(), 0.0);
  EXPECT_FALSE(plain.is_torque_controlled());
  ObjectDictionary objects = make_objects(settings());
  EXPECT_EQ(objects.find(0x6071, 0), nullptr);
  EXPECT_EQ(objects.get(0x6502), 0x80);
}

TEST_F(TorqueDrive, AgainstAWallTheGearGivesWhatIsAskedForAndReportsIt) {
  joint_.wall_Nm_rad = 2000.0;
  EXPECT_EQ(write(0x3001, 2, 4, 0), 0U);  // without the drift integral it is a force, and nothing else
  enable_torque();
  run(3000, 200);
  EXPECT_NEAR(joint_.gear_Nm(), 0.2 * kRated_Nm, 0.3);
  EXPECT_NEAR(static_cast<std::int16_t>(*read(0x6077, 0)), 200, 3);
}

TEST_F(TorqueDrive, TheTorqueOffsetIsAddedToTheTarget) {
  joint_.wall_Nm_rad = 2000.0;
  EXPECT_EQ(write(0x3001, 2, 4, 0), 0U);
  EXPECT_EQ(write(0x60B2, 0, 2, 100), 0U);
  enable_torque();
  run(3000, 100);
  EXPECT_NEAR(joint_.gear_Nm(), 0.2 * kRated_Nm, 0.3);
}

// The damping is against the velocity offset, so that the joint goes at that rate, whatever rubs.
TEST_F(TorqueDrive, AFreeJointGoesAtTheRateThatItsDampingIsAgainst) {
  enable_torque();
  const double rate_rad_s = 0.02;
  run(500, 0, static_cast<std::int32_t>(rate_rad_s / kRadPerCount));
  EXPECT_NEAR(joint_.link_rate, rate_rad_s, 1e-4);
  EXPECT_EQ(read(0x606C, 0).has_value(), true);
  run(500, 0, 0);
  EXPECT_NEAR(joint_.link_rate, 0.0, 1e-4);
}

TEST_F(TorqueDrive, ItsMotorGivesNoMoreThanMaxTorque) {
  EXPECT_EQ(write(0x6072, 0, 2, 500), 0U);
  enable_torque();
  run(100, 3000, 100000);
  EXPECT_LE(max_Nm_, 0.5 * kRated_Nm + 1e-9);
  EXPECT_GT(max_Nm_, 0.49 * kRated_Nm);
}

struct Ending {
  const char* name;
  std::optional<int> controlword;
  bool faulty;
  PowerState after;
};

// Whatever ends torque, the force leaves the arm first, damping stays, and the brake closes on a joint that rests.
TEST_F(TorqueDrive, EveryWayToRestTakesTheForceOutBeforeTheBrakeCloses) {
  const Ending endings[] = {{"no targets any more", std::nullopt, false, PowerState::kSwitchOnDisabled},
                            {"quick stop", 0x02, false, PowerState::kSwitchOnDisabled},
                            {"a fault of the drive", 0x0F, true, PowerState::kFault}};
  joint_.wall_Nm_rad = 2000.0;
  EXPECT_EQ(write(0x6060, 0, 1, 10), 0U);
  for (const Ending& ending : endings) {
    if (drive_.power_state() == PowerState::kFault) period(0x80);
    enable_torque();
    EXPECT_EQ(read(0x6061, 0), 10U) << ending.name << ": enabled again, it gives torque again";
    run(1500, 200);
    ASSERT_GT(joint_.gear_Nm(), 5.0) << ending.name;  // the drift integral holds the rest
    if (ending.faulty) drive_.raise_fault(0x8400);
    const int periods = until_braked(ending.controlword);
    EXPECT_GT(periods, 125) << ending.name << ": half a second of rest";
    EXPECT_LT(periods, 1400) << ending.name;
    EXPECT_LT(std::fabs(joint_.gear_Nm()), 2.0) << ending.name;
    EXPECT_EQ(drive_.power_state(), ending.after) << ending.name;
    EXPECT_EQ(read(0x6061, 0), 8U) << ending.name;
    EXPECT_EQ(read(0x607A, 0), read(0x6064, 0)) << ending.name << ": position control begins where the joint is";
    period(0x00);
  }
}

TEST_F(TorqueDrive, PositionControlTakesOverWhereTheJointIs) {
  enable_torque();
  run(250, 0, 2000);
  const std::uint32_t before = *read(0x6064, 0);
  EXPECT_EQ(write(0x6060, 0, 1, 8), 0U);
  EXPECT_FALSE(drive_.is_torque_controlled());
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
  run(50, 0);
  EXPECT_NEAR(static_cast<double>(*read(0x6064, 0)), static_cast<double>(before), 10.0);
}

TEST(TorqueLoop, AtItsLimitNothingWindsUp) {
  TorqueLoop loop;
  const TorqueGains gains;
  for (int i = 0; i < 10000; ++i) EXPECT_EQ(loop.step(0.001, gains, {500.0, 0.0}, {0.0, 0.0}, 300.0), 300.0);
  TorqueLoop fresh;
  EXPECT_NEAR(loop.step(0.001, gains, {0.0, 0.0}, {0.0, 0.0}, 300.0),
              fresh.step(0.001, gains, {0.0, 0.0}, {0.0, 0.0}, 300.0), 1e-9);
}

TEST(TorqueStop, RampsFirstAndWaitsForRestButNotForEver) {
  TorqueStop stop(40.0, 0.1);
  EXPECT_EQ(stop.step(0.001, false), 40.0);
  for (int i = 0; i < 49; ++i) stop.step(0.001, false);
  EXPECT_NEAR(stop.step(0.001, false), 20.0, 1e-9);
  for (int i = 0; i < 100; ++i) stop.step(0.001, true);
  EXPECT_EQ(stop.step(0.001, true), 0.0);
  EXPECT_FALSE(stop.done());
  for (int i = 0; i < 400; ++i) stop.step(0.001, true);
  EXPECT_TRUE(stop.done());
  TorqueStop restless(40.0, 0.1);
  for (int i = 0; i < 4990; ++i) restless.step(0.001, false);
  EXPECT_FALSE(restless.done());
  for (int i = 0; i < 20; ++i) restless.step(0.001, false);
  EXPECT_TRUE(restless.done());
}

}  // namespace
}  // namespace liana::bench
