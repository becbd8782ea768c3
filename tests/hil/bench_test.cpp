// The whole bench behind a scripted bus: boot, enable, truth, determinism; and the packets of the embedded bus.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "bench_harness.hpp"
#include "hil/bench/drives.hpp"
#include "hil/bus/embedded_bus.hpp"
#include "hil/bus/packets.hpp"
#include "hil/bus/socketcan_bus.hpp"

namespace liana::bench {
namespace {

TEST(WholeBench, BootsEnablesAndWritesOneTruthRowPerSlot) {
  BenchOptions options = options_of(1);
  options.truth_path = temporary("truth.bin");
  options.summary_path = temporary("summary.json");
  Bench bench(options);
  ScriptedBus bus(200, 0);
  bench.run(bus);
  EXPECT_EQ(bus.boot_ups, 15);
  EXPECT_EQ(bus.tpdos, 15 * 180);
  const Truth truth = read_truth(options.truth_path);
  ASSERT_EQ(truth.rows.size(), 200U);
  EXPECT_EQ(truth.at(199, "slot"), 199.0);
  EXPECT_EQ(truth.at(30, "enabled"), 0.0);
  EXPECT_EQ(truth.at(199, "enabled"), 15.0);
  EXPECT_GT(truth.at(199, "tension_min_N"), 14.0);
  EXPECT_LT(truth.at(199, "tension_motor_max_N"), 80.0);
  EXPECT_NEAR(truth.at(199, "theta_deg_3"), -12.0, 0.51);
  EXPECT_NEAR(truth.at(199, "theta_deg_3"), truth.at(0, "theta_deg_3"), 0.01) << "enabling does not jerk";
  // Torque readings: permille of 9 N.m at 15 mm, 1 % gain and 0.3 % noise.
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_GT(bus.torque_permille[i] * 0.6, 0.97 * truth.at(199, "tension_motor_min_N") - 0.6);
    EXPECT_LT(bus.torque_permille[i] * 0.6, 1.03 * truth.at(199, "tension_motor_max_N") + 0.6);
  }
  const auto summary = nlohmann::json::parse(content(options.summary_path));
  EXPECT_EQ(summary.at("slots"), 200);
  EXPECT_EQ(summary.at("mujoco_warnings"), 0);
  EXPECT_EQ(summary.at("drives").size(), 15U);
  EXPECT_EQ(summary.at("drives")[3].at("sdo_aborts"), 0);
  EXPECT_GT(summary.at("drives")[14].at("rpdos").get<int>(), 100);
}

TEST(WholeBench, AGearChangesCountsAndTheMotorsRatedTorqueAndNoReading) {
  for (const double gear : {5.0, 0.2}) {
    BenchOptions options = options_of(1);
    options.robot.gear = gear;
    options.truth_path = temporary("geared.bin");
    EXPECT_DOUBLE_EQ(drive_settings(options.robot, options.buses, 0).rated_torque_mNm, 9000.0 / gear);
    Bench bench(options);
    ScriptedBus bus(200, 0);
    bench.run(bus);
    const Truth truth = read_truth(options.truth_path);
    for (std::size_t i = 0; i < 15; ++i) {
      EXPECT_GT(bus.torque_permille[i] * 0.6, 0.97 * truth.at(199, "tension_motor_min_N") - 0.6) << gear;
      EXPECT_LT(bus.torque_permille[i] * 0.6, 1.03 * truth.at(199, "tension_motor_max_N") + 0.6) << gear;
    }
  }
}

TEST(WholeBench, TwoRunsWithOneSeedAreIdenticalAndAnotherSeedIsNot) {
  std::vector<std::string> truths;
  for (const std::uint64_t seed : {3U, 3U, 4U}) {
    BenchOptions options = options_of(seed);
    options.truth_path = temporary("repeat.bin");
    {
      Bench bench(options);
      ScriptedBus bus(300, 5);
      bench.run(bus);
    }
    truths.push_back(content(options.truth_path));
  }
  EXPECT_EQ(truths[0], truths[1]);
  EXPECT_NE(truths[0], truths[2]);
}

TEST(EmbeddedPackets, AreLaidOutAsTheProtocolSays) {
  const Packet hello = make_hello("liana-bench");
  ASSERT_EQ(hello.size(), 32U);
  EXPECT_EQ(hello[0], 1);
  EXPECT_EQ(hello[1], 1);
  EXPECT_EQ(hello[2], 1);
  EXPECT_EQ(std::string(hello.begin() + 4, hello.begin() + 15), "liana-bench");
  const Packet yield = make_yield(true, 0x0102030405060708, {frame_of(1, 0x185, {9, 8})});
  ASSERT_EQ(yield.size(), 40U);
  EXPECT_EQ(yield[0], 4);
  EXPECT_EQ(yield[1], 1);
  EXPECT_EQ(yield[2], 1);
  EXPECT_EQ(yield[8], 0x08);
  EXPECT_EQ(yield[15], 0x01);
  EXPECT_EQ(yield[16 + 8], 0x85);
  EXPECT_EQ(yield[16 + 9], 0x01);
  EXPECT_EQ(yield[16 + 12], 1);
  EXPECT_EQ(yield[16 + 13], 2);
  EXPECT_EQ(yield[16 + 16], 9);
  const std::string reason = "no such bus";
  Packet error{5};
  error.insert(error.end(), reason.begin(), reason.end());
  EXPECT_THROW(read_wake(error), std::runtime_error);
  EXPECT_THROW(read_wake(Packet(3, 3)), std::runtime_error);
}

// One WAKE with a SYNC on each bus, then SHUTDOWN; keeps what the bench answered. In real time the WAKE comes late.
class OneWakeBus {
 public:
  static constexpr std::uint8_t kReal = 2;
  explicit OneWakeBus(std::uint8_t time_mode = 0)
      : time_mode_(time_mode), path_(temporary("bus.sock")), listener_(::socket(AF_UNIX, SOCK_SEQPACKET, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    ::unlink(path_.c_str());
    EXPECT_EQ(::bind(listener_.descriptor(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_.descriptor(), 1), 0);
    thread_ = std::thread([this] { serve(); });
  }
  ~OneWakeBus() { finish(); }
  void finish() {
    if (thread_.joinable()) thread_.join();
  }
  const std::string& path() const { return path_; }
  Packet hello;
  Packet yield;

 private:
  void serve() {
    const Socket peer(::accept(listener_.descriptor(), nullptr, nullptr));
    const auto receive = [&] {
      Packet packet(kMaxPacketBytes);
      packet.resize(
          static_cast<std::size_t>(std::max<ssize_t>(0, ::recv(peer.descriptor(), packet.data(), packet.size(), 0))));
      return packet;
    };
    const auto send = [&](const Packet& packet) {
      ::send(peer.descriptor(), packet.data(), packet.size(), MSG_NOSIGNAL);
    };
    hello = receive();
    Packet welcome(8 + 32);
    welcome[0] = 2;
    welcome[1] = time_mode_;
    welcome[2] = 2;
    put_little_endian(&welcome[4], 4, 4000);
    send(welcome);
    if (time_mode_ == kReal) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    Packet wake(16 + 48);
    wake[0] = 3;
    wake[2] = 2;
    put_little_endian(&wake[4], 4, 7);
    put_little_endian(&wake[8], 8, 28047);
    for (std::size_t i = 0; i < 2; ++i) {
      put_little_endian(&wake[16 + 24 * i], 8, 28047);
      put_little_endian(&wake[16 + 24 * i + 8], 4, 0x080);
      wake[16 + 24 * i + 12] = static_cast<std::uint8_t>(i);
    }
    send(wake);
    yield = receive();
    Packet shutdown(16);
    shutdown[0] = 3;
    shutdown[1] = 1;
    send(shutdown);
  }

  std::uint8_t time_mode_;
  std::string path_;
  Socket listener_;
  std::thread thread_;
};

TEST(EmbeddedBusClient, WaitsInRealTimeForTheFirstWakeWhoseClockTheDrivesHave) {
  OneWakeBus server(OneWakeBus::kReal);
  EmbeddedBus bus(server.path(), 4000, 2);
  ASSERT_FALSE(bus.lockstep());
  Wake wake;
  ASSERT_TRUE(bus.wait(wake));
  EXPECT_EQ(wake.now_us, 28047U) << "by no clock of its own: it would be ahead of the bus";
  EXPECT_EQ(wake.frames.size(), 2U);
  ASSERT_TRUE(bus.wait(wake));
  EXPECT_GT(wake.now_us, 28047U) << "from then on drives go on without frames";
  EXPECT_EQ(wake.frames.size(), 0U);
  bus.send({CanFrame{}});
  server.finish();
}

TEST(EmbeddedBusClient, AnswersASyncWithWhatTheDrivesSendAndAsksForTheNext) {
  OneWakeBus server;
  Bench bench(options_of(1));
  {
    EmbeddedBus bus(server.path(), 4000, 2);
    EXPECT_TRUE(bus.lockstep());
    bench.run(bus);
  }
  server.finish();
  ASSERT_EQ(server.hello.size(), 32U);
  ASSERT_EQ(server.yield.size(), 16U + 24U * 15U) << "fifteen boot-ups";
  EXPECT_EQ(server.yield[1], 1) << "wake on SYNC";
  EXPECT_EQ(get_little_endian(&server.yield[8], 8), 9U * 4000U) << "a period after the end of slot 7";
}

TEST(EmbeddedBusClient, RefusesABusWithAnotherPeriod) {
  OneWakeBus server;
  EXPECT_THROW(EmbeddedBus(server.path(), 10000, 2), std::runtime_error);
}

// The signal comes between the look whether an end is asked for and the read: another thread takes it, so that nothing
// interrupts the read.
TEST(EmbeddedBusClient, EndsThoughNoSignalInterruptsItsRead) {
  const auto ends = [] {
    const std::string path = temporary("silent.sock");
    const Socket listener(::socket(AF_UNIX, SOCK_SEQPACKET, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    ::unlink(path.c_str());
    ::bind(listener.descriptor(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listener.descriptor(), 1);
    std::thread server([&listener] {
      const Socket peer(::accept(listener.descriptor(), nullptr, nullptr));
      Packet welcome(8 + 32);
      welcome[0] = 2, welcome[2] = 2;
      put_little_endian(&welcome[4], 4, 4000);
      ::send(peer.descriptor(), welcome.data(), welcome.size(), MSG_NOSIGNAL);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      ::raise(SIGTERM);  // in this thread
      std::this_thread::sleep_for(std::chrono::seconds(20));
    });
    server.detach();
    end_on_signals();
    EmbeddedBus bus(path, 4000, 2);
    Wake wake;
    const auto before = std::chrono::steady_clock::now();
    const bool goes_on = bus.wait(wake);
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - before;
    std::filesystem::remove_all(std::filesystem::path(path).parent_path());  // _Exit calls no destructor
    std::_Exit(!goes_on && waited.count() < 5.0 ? 0 : 1);
  };
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(ends(), ::testing::ExitedWithCode(0), "");
}

TEST(SocketCan, WithoutTheInterfaceSaysWhatIsMissing) {
  try {
    SocketCanBus bus({"nosuchcan9"}, 4000);
    FAIL() << "an interface that does not exist was opened";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("SocketCAN: ", 0), 0U) << error.what();
  }
}

TEST(BenchConfig, ComplainsWithFileFieldValueAndRange) {
  const std::string path = temporary("bad.json");
  auto robot = nlohmann::json::parse(content(HIL_DATA "/robot.json"));
  robot["cables"]["EA_N"] = -1;
  std::ofstream(path) << robot.dump();
  try {
    load_robot(path);
    FAIL() << "a negative stiffness was accepted";
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    for (const char* part : {path.c_str(), "/cables/EA_N", "-1", "allowed is"})
      EXPECT_NE(what.find(part), std::string::npos) << what;
  }
  EXPECT_THROW(load_robot(HIL_DATA "/scene.json"), std::runtime_error);
  EXPECT_THROW(load_robot("nowhere.json"), std::runtime_error);
}

TEST(BenchConfig, ANameThatNoPathCanHoldIsRefused) {
  auto robot = nlohmann::json::parse(content(HIL_DATA "/robot.json"));
  for (const char* name : {"i~eal", "no/minal"}) {
    const std::string path = temporary("names.json");
    robot["cables"]["friction_mu"] = {{name, 0.05}};
    std::ofstream(path) << robot.dump();
    try {
      load_robot(path);
      FAIL() << name << " was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("holds the name '") + name), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace liana::bench
