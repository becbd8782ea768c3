// The whole bench behind a scripted bus: boot, enable, truth, determinism, faults; and the packets of the embedded bus.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "fixtures.hpp"
#include "hil/bench/bench.hpp"
#include "hil/bus/embedded_bus.hpp"
#include "hil/bus/packets.hpp"
#include "hil/bus/socketcan_bus.hpp"

namespace liana::bench {
namespace {

CanFrame frame_of(std::uint8_t bus, std::uint32_t id, std::vector<std::uint8_t> bytes) {
  CanFrame frame;
  frame.bus = bus;
  frame.id = id;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

// A master in lockstep: maps and starts all drives, then enables them and moves every target by `counts_per_slot`.
class ScriptedBus final : public Bus {
 public:
  ScriptedBus(std::uint32_t slots, int counts_per_slot) : slots_(slots), counts_per_slot_(counts_per_slot), position_(16, 0) {}

  bool wait(Wake& wake) override {
    if (slot_ >= slots_) return false;
    wake.slot = slot_;
    wake.now_us = 4000ULL * slot_ + 50;
    wake.frames.clear();
    for (std::uint8_t node = 1; node <= 15; ++node) add_for(node, wake.frames);
    for (const std::uint8_t bus : {std::uint8_t{0}, std::uint8_t{1}}) wake.frames.push_back(frame_of(bus, 0x080, {}));
    for (auto& frame : wake.frames) frame.time_us = wake.now_us;
    ++slot_;
    return true;
  }
  void send(const FrameList& frames) override {
    for (const auto& frame : frames) {
      boot_ups += frame.id > 0x700 && frame.data[0] == 0 ? 1 : 0;
      if (frame.id <= 0x180 || frame.id > 0x18F) continue;
      ++tpdos;
      const std::size_t node = frame.id - 0x180;
      if (slot_ < kEnableSlot) position_[node] = static_cast<std::int32_t>(get_little_endian(&frame.data[2], 4));
      torque_permille[node - 1] = static_cast<int>(get_little_endian(&frame.data[6], 2));
    }
  }
  bool lockstep() const override { return true; }
  std::uint32_t period_us() const override { return 4000; }
  std::uint64_t refused() const override { return 0; }

  int boot_ups = 0;
  int tpdos = 0;
  std::array<int, 15> torque_permille{};

 private:
  static constexpr std::uint32_t kEnableSlot = 40;

  void add_for(std::uint8_t node, FrameList& frames) {
    const auto bus = static_cast<std::uint8_t>(node <= 8 ? 0 : 1);
    static const std::vector<std::vector<std::uint8_t>> kSetup = {
        {0x23, 0x00, 0x14, 1, 0, 2, 0, 0x80},       {0x23, 0x00, 0x16, 1, 0x10, 0, 0x40, 0x60},
        {0x23, 0x00, 0x16, 2, 0x20, 0, 0x7A, 0x60}, {0x2F, 0x00, 0x16, 0, 2},
        {0x23, 0x00, 0x14, 1, 0, 2, 0, 0},          {0x23, 0x00, 0x18, 1, 0x80, 1, 0, 0x80},
        {0x23, 0x00, 0x1A, 1, 0x10, 0, 0x41, 0x60}, {0x23, 0x00, 0x1A, 2, 0x20, 0, 0x64, 0x60},
        {0x23, 0x00, 0x1A, 3, 0x10, 0, 0x77, 0x60}, {0x2F, 0x00, 0x1A, 0, 3},
        {0x23, 0x00, 0x18, 1, 0x80, 1, 0, 0},       {0x2F, 0x60, 0x60, 0, 8}};
    if (slot_ >= 2 && slot_ < 2 + kSetup.size()) {
      auto bytes = kSetup[slot_ - 2];
      bytes.resize(8);
      if (bytes[2] == 0x14 || bytes[2] == 0x18) bytes[4] = static_cast<std::uint8_t>(bytes[4] + node);
      frames.push_back(frame_of(bus, 0x600U + node, bytes));
    }
    if (slot_ == 20) frames.push_back(frame_of(bus, 0x000, {0x01, node}));
    if (slot_ < kEnableSlot) return;
    const std::uint32_t since = slot_ - kEnableSlot;
    const std::uint8_t controlword = since < 2 ? 0x06 : (since < 4 ? 0x07 : 0x0F);
    if (since >= 50) position_[node] += counts_per_slot_;
    const auto target = static_cast<std::uint32_t>(position_[node]);
    frames.push_back(frame_of(bus, 0x200U + node,
                              {controlword, 0, static_cast<std::uint8_t>(target), static_cast<std::uint8_t>(target >> 8),
                               static_cast<std::uint8_t>(target >> 16), static_cast<std::uint8_t>(target >> 24)}));
  }

  std::uint32_t slots_;
  std::uint32_t slot_ = 0;
  int counts_per_slot_;
  std::vector<std::int32_t> position_;
};

BenchOptions options_of(std::uint64_t seed) {
  BenchOptions options;
  options.robot = fixture_robot();
  options.scene = fixture_scene();
  options.buses = fixture_buses();
  options.seed = seed;
  return options;
}

std::string temporary(const std::string& name) { return testing::TempDir() + "bench_" + std::to_string(::getpid()) + "_" + name; }

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}

struct Truth {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  double at(std::size_t row, const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    return rows.at(row).at(static_cast<std::size_t>(found - columns.begin()));
  }
};

Truth read_truth(const std::string& path) {
  const std::string bytes = content(path);
  const std::size_t line = bytes.find('\n');
  Truth truth;
  truth.columns = nlohmann::json::parse(bytes.substr(0, line)).at("columns").get<std::vector<std::string>>();
  for (std::size_t at = line + 1; at < bytes.size(); at += 8 * truth.columns.size()) {
    truth.rows.emplace_back(truth.columns.size());
    std::memcpy(truth.rows.back().data(), bytes.data() + at, 8 * truth.columns.size());
  }
  return truth;
}

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

TEST(WholeBench, FaultsHitTheDriveAndTheSlotTheyName) {
  for (const auto& [kind, expected] :
       {std::pair{FaultKind::kMissing, 14.0}, std::pair{FaultKind::kFault, 14.0}, std::pair{FaultKind::kSto, 14.0},
        std::pair{FaultKind::kSilent, 15.0}, std::pair{FaultKind::kSlack, 15.0}}) {
    BenchOptions options = options_of(1);
    options.truth_path = temporary("fault.bin");
    options.faults = {{3, kind, 120}};
    ScriptedBus bus(160, 0);
    {
      Bench bench(options);
      bench.run(bus);
    }
    const Truth truth = read_truth(options.truth_path);
    EXPECT_EQ(truth.at(119, "enabled"), 15.0);
    EXPECT_EQ(truth.at(159, "enabled"), expected);
    EXPECT_EQ(truth.at(159, "tension_min_N") == 0.0, kind == FaultKind::kSlack);
    const bool quiet = kind == FaultKind::kMissing || kind == FaultKind::kSilent;
    EXPECT_EQ(bus.tpdos, quiet ? 15 * 140 - 40 : 15 * 140);
  }
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

// One WAKE with a SYNC on each bus, then SHUTDOWN; keeps what the bench answered.
class OneWakeBus {
 public:
  OneWakeBus() : path_(temporary("bus.sock")), listener_(::socket(AF_UNIX, SOCK_SEQPACKET, 0)) {
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
      packet.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::recv(peer.descriptor(), packet.data(), packet.size(), 0))));
      return packet;
    };
    const auto send = [&](const Packet& packet) { ::send(peer.descriptor(), packet.data(), packet.size(), MSG_NOSIGNAL); };
    hello = receive();
    Packet welcome(8 + 32);
    welcome[0] = 2;
    welcome[2] = 2;
    put_little_endian(&welcome[4], 4, 4000);
    send(welcome);
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

  std::string path_;
  Socket listener_;
  std::thread thread_;
};

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
    for (const char* part : {path.c_str(), "/cables/EA_N", "-1", "allowed is"}) EXPECT_NE(what.find(part), std::string::npos) << what;
  }
  EXPECT_THROW(load_robot(HIL_DATA "/scene.json"), std::runtime_error);
  EXPECT_THROW(load_robot("nowhere.json"), std::runtime_error);
  std::ofstream(path) << R"([{"drive":15,"kind":"fault","at_slot":1}])";
  EXPECT_THROW(load_faults(path, 15), std::runtime_error);
  std::ofstream(path) << R"([{"drive":3,"kind":"tired","at_slot":1}])";
  EXPECT_THROW(load_faults(path, 15), std::runtime_error);
}

}  // namespace
}  // namespace liana::bench
