// Everything that can be wrong when buses are opened has a message that says what to do.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "host/drives/bus/can_interface.hpp"
#include "tests/host/drives/bus/embedded_bench.hpp"
#include "tests/message.hpp"

namespace liana::bus {
namespace {

using test::BusThread;
using test::PlantThread;
using test::small_table;

std::string refusal(const config::BusesConfig& config, timing::TimeMode mode, const std::string& socket) {
  try {
    open_drive_bus(config, mode, socket);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(OpenDriveBus, SaysWhichProgramToStartWhenNobodyListens) {
  EXPECT_TRUE(names(refusal(small_table(), timing::TimeMode::kFast, "/tmp/no-such-liana-bus"),
                    {"liana-bus", "--socket", "/tmp/no-such-liana-bus"}));
  EXPECT_TRUE(names(refusal(small_table(), timing::TimeMode::kFast, ""), {"--bus-socket"}));
  EXPECT_TRUE(names(refusal(small_table(), timing::TimeMode::kFast, std::string(200, 'x')), {"1", "107 bytes"}));
}

TEST(OpenDriveBus, ChecksTheTableFirst) {
  config::BusesConfig config = small_table();
  config.rate_hz = 150;
  EXPECT_TRUE(names(refusal(config, timing::TimeMode::kFast, "/tmp/no-such-liana-bus"), {"60C2"}));
  config = small_table();
  config.backend = "pigeons";
  EXPECT_TRUE(names(refusal(config, timing::TimeMode::kFast, ""), {"pigeons", "embedded", "socketcan"}));
}

// Both participants come and leave, so that the bus ends.
void meet_and_part(const std::string& path) {
  const int plant = test::connect_patiently(path);
  test::say_hello(plant, wire::Role::kPlant);
  const int controller = test::connect_patiently(path);
  test::say_hello(controller, wire::Role::kController);
  wire::Welcome welcome;
  recv(plant, &welcome, sizeof welcome, 0);
  recv(controller, &welcome, sizeof welcome, 0);
  close(plant);
  close(controller);
}

TEST(OpenDriveBus, RefusesABusProcessWithAnotherTable) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  config::BusesConfig other = small_table();
  other.buses[1].bitrate = 1000000;
  std::string message;
  while ((message = refusal(other, timing::TimeMode::kFast, bus_thread.socket_path())).find("first") !=
         std::string::npos)
    usleep(10000);
  EXPECT_TRUE(names(message, {"can1 at 500000", "can1 at 1000000"}));
  meet_and_part(bus_thread.socket_path());
}

TEST(OpenDriveBus, RefusesABusProcessInAnotherTimeMode) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  std::string message;
  while ((message = refusal(small_table(), timing::TimeMode::kPaced, bus_thread.socket_path())).find("first") !=
         std::string::npos)
    usleep(10000);
  EXPECT_TRUE(names(message, {"fast", "paced"}));
  meet_and_part(bus_thread.socket_path());
}

TEST(OpenDriveBus, SocketCanHasNoVirtualTime) {
  config::BusesConfig config = small_table();
  config.backend = "socketcan";
  EXPECT_TRUE(names(refusal(config, timing::TimeMode::kFast, ""), {"SocketCAN", "virtual time"}));
}

TEST(OpenDriveBus, NamesAMissingInterfaceOrAMissingKernelPart) {
  config::BusesConfig config = small_table();
  config.backend = "socketcan";
  config.buses[0].name = "nocan7";
  const std::string message = refusal(config, timing::TimeMode::kReal, "");
  const int probe = socket(PF_CAN, SOCK_RAW, 1);
  if (probe < 0) {
    EXPECT_TRUE(names(message, {"kernel", "CAN", "--bus embedded"}));
  } else {
    close(probe);
    EXPECT_TRUE(names(message, {"nocan7", "this machine"}));
  }
}

TEST(BusListener, RefusesASecondPlantByName) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  const int first = test::connect_patiently(bus_thread.socket_path());
  test::say_hello(first, wire::Role::kPlant);
  const int second = test::connect_patiently(bus_thread.socket_path());
  test::say_hello(second, wire::Role::kPlant);
  char text[256] = {};
  ASSERT_GT(recv(second, text, sizeof text - 1, 0), 1);
  EXPECT_EQ(text[0], static_cast<char>(wire::Type::kError));
  EXPECT_TRUE(names(text + 1, {"plant", "already"}));
  close(second);
  const int controller = test::connect_patiently(bus_thread.socket_path());
  test::say_hello(controller, wire::Role::kController);
  wire::Welcome welcome;
  EXPECT_GT(recv(controller, &welcome, sizeof welcome, 0), 0);
  close(controller);
  bus_thread.outcome();
  close(first);
}

// A controller that answers the first WAKE with `yield`; what the bus says about it.
std::string complaint_about(const void* packet, std::size_t size) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  PlantThread plant(bus_thread.socket_path(), [](const wire::Wake&) { return std::vector<wire::Frame>{}; });
  const int controller = test::connect_patiently(bus_thread.socket_path());
  test::say_hello(controller, wire::Role::kController);
  std::vector<char> scratch(8192);
  recv(controller, scratch.data(), scratch.size(), 0);  // WELCOME
  recv(controller, scratch.data(), scratch.size(), 0);  // WAKE
  send(controller, packet, size, MSG_NOSIGNAL);
  bus_thread.outcome();
  close(controller);
  return bus_thread.outcome().end_reason;
}

TEST(BusListener, EndsWithAReasonWhenAParticipantTalksNonsense) {
  wire::Yield yield;
  EXPECT_TRUE(names(complaint_about(&yield, yield.size()), {"controller", "woken"}));
  yield.until_us = 4000;
  yield.frame_count = 3;
  EXPECT_TRUE(names(complaint_about(&yield, yield.size() - 1), {"controller", "packet"}));
  yield.frame_count = 1;
  yield.frame[0].bus = 2;
  EXPECT_TRUE(names(complaint_about(&yield, yield.size()), {"controller", "frame"}));
  yield.frame[0].bus = 0;
  yield.frame[0].length = 9;
  EXPECT_TRUE(names(complaint_about(&yield, yield.size()), {"controller", "frame"}));
  yield.frame_count = 0;
  yield.flags = wire::kYieldLeave;
  EXPECT_EQ(complaint_about(&yield, yield.size()), "controller left");
}

}  // namespace
}  // namespace liana::bus
