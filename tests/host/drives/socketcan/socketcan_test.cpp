// SocketCAN on real interfaces of the kernel: vcan0 and vcan1 must exist and be up, and the user must be allowed to
// change them.
#include <gtest/gtest.h>
#include <linux/can.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "host/drives/bus/can_interface.hpp"
#include "host/drives/canopen/master.hpp"
#include "tests/host/drives/bus/fake_drive.hpp"
#include "tests/message.hpp"

namespace liana::bus {
namespace {

config::BusesConfig vcan_table() {
  config::BusesConfig config;
  config.name = "vcan";
  config.backend = "socketcan";
  config.rate_hz = 50;  // an emulated processor must keep up
  config.command_interval_s = 0.02;
  config.heartbeat_ms = 100;
  config.max_load = 0.75;
  config.buses = {{"vcan0", 1000000, {1}}, {"vcan1", 1000000, {2}}};
  return config;
}

int raw_socket(const std::string& interface) {
  const int descriptor = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  EXPECT_EQ(bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0) << interface;
  return descriptor;
}

void write_frame(int descriptor, const CanFrame& frame) {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.length;
  std::copy_n(frame.data.begin(), 8, raw.data);
  EXPECT_EQ(write(descriptor, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
}

// A fake drive on an interface, until it is destroyed.
class DriveThread {
 public:
  DriveThread(const std::string& interface, const canopen::ExpectedDrive& is)
      : descriptor_(raw_socket(interface)), thread_([this, is] { run(test::FakeDrive(is)); }) {}
  ~DriveThread() {
    end_ = true;
    thread_.join();
    close(descriptor_);
  }

 private:
  void run(test::FakeDrive drive) {
    for (int round = 0; !end_; ++round) {
      pollfd ready{descriptor_, POLLIN, 0};
      if (poll(&ready, 1, 20) > 0) answer(drive);
      if (round % 5 != 0) continue;
      for (const CanFrame& frame : drive.heartbeat()) write_frame(descriptor_, frame);
    }
  }

  void answer(test::FakeDrive& drive) {
    can_frame raw{};
    if (read(descriptor_, &raw, sizeof raw) != static_cast<ssize_t>(sizeof raw)) return;
    CanFrame frame{raw.can_id, raw.can_dlc, {}, 0};
    std::copy_n(raw.data, 8, frame.data.begin());
    for (const CanFrame& reply : drive.receive(frame)) write_frame(descriptor_, reply);
  }

  int descriptor_;
  std::atomic<bool> end_ = false;
  std::thread thread_;
};

std::string refusal_of(const std::string& interface) {
  try {
    close(open_can_interface(interface));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

void shell(const std::string& command) { EXPECT_EQ(std::system(command.c_str()), 0) << command; }

TEST(SocketCan, BootsDrivesOnTwoInterfacesAndCollectsTheirFeedback) {
  const config::BusesConfig table = vcan_table();
  const std::vector<canopen::ExpectedDrive> expected{test::expectation(0, 1), test::expectation(1, 2)};
  DriveThread first("vcan0", expected[0]);
  DriveThread second("vcan1", expected[1]);
  auto bus = open_drive_bus(table, timing::TimeMode::kReal, "");
  canopen::Master master(expected, table);
  int tpdos = 0;
  std::uint64_t tick = 0;
  for (int i = 0; i < 400 && tpdos < 100; ++i) {
    tick = bus->begin_tick(tick).tick + 1;
    EXPECT_EQ(bus->write_sync(), SendResult::kOk);
    bus->wait_feedback(master.boot().state() == canopen::BootState::kOperational ? 2 : 0);
    for (ReceivedFrame received; bus->receive(received);) {
      EXPECT_NE(received.frame.id, 0x080U) << "own frames do not come back";
      if (!master.on_frame(received.bus, received.frame, tick)) ++tpdos;
    }
    master.step(*bus);
    bus->end_tick();
  }
  EXPECT_EQ(master.boot().state(), canopen::BootState::kOperational)
      << canopen::describe(master.boot().mismatches(0), master.boot().more_mismatches(0), "node 1 on vcan0");
  EXPECT_GE(tpdos, 100);
  EXPECT_FALSE(master.heartbeats().lost(1));
  EXPECT_EQ(bus->stats(0).state, BusState::kActive);
  EXPECT_GT(bus->stats(0).bits, 0U);
}

TEST(SocketCan, AMissingInterfaceIsNamedTogetherWithThoseThatExist) {
  const std::string message = refusal_of("can77");
  EXPECT_TRUE(names(message, {"can77", "vcan0", "vcan1"}));
}

TEST(SocketCan, AnInterfaceThatIsNoCanOneIsRefused) { EXPECT_TRUE(names(refusal_of("lo"), {"lo", "CAN interface"})); }

TEST(SocketCan, AnInterfaceThatIsDownIsRefusedWithTheCommandThatHelps) {
  shell("ip link set vcan1 down");
  EXPECT_TRUE(names(refusal_of("vcan1"), {"ip link set vcan1 up"}));
  shell("ip link set vcan1 up");
  EXPECT_EQ(refusal_of("vcan1"), "");
}

TEST(SocketCan, ATransmitQueueTooShortForATickIsRefused) {
  shell("ip link set vcan1 txqueuelen 10");
  EXPECT_TRUE(names(refusal_of("vcan1"), {"vcan1", "txqueuelen 128"}));
  shell("ip link set vcan1 txqueuelen 128");
  EXPECT_EQ(refusal_of("vcan1"), "");
}

TEST(SocketCan, AnInterfaceThatGoesDownIsSeenAndItsReturnToo) {
  auto bus = open_drive_bus(vcan_table(), timing::TimeMode::kReal, "");
  const int other = raw_socket("vcan1");
  bus->begin_tick(0);
  EXPECT_EQ(bus->write_sync(), SendResult::kOk);
  shell("ip link set vcan1 down");
  EXPECT_EQ(bus->write_sync(), SendResult::kDown);
  EXPECT_EQ(bus->stats(0).state, BusState::kActive);
  EXPECT_EQ(bus->stats(1).state, BusState::kDown);
  bus->wait_feedback(1);  // must come back although the socket reports an error
  shell("ip link set vcan1 up");
  EXPECT_EQ(bus->write_sync(), SendResult::kOk);
  EXPECT_EQ(bus->stats(1).state, BusState::kActive);
  int old_error = 0;  // the other end has noticed, too
  socklen_t size = sizeof old_error;
  getsockopt(other, SOL_SOCKET, SO_ERROR, &old_error, &size);
  write_frame(other, {0x182, 8, {}, 0});
  bus->begin_tick(1);
  bus->wait_feedback(1);
  ReceivedFrame received;
  ASSERT_TRUE(bus->receive(received));
  EXPECT_EQ(received.bus, 1);
  EXPECT_EQ(received.frame.id, 0x182U);
  close(other);
}

}  // namespace
}  // namespace liana::bus
