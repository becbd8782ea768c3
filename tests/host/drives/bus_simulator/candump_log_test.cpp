// Bus logs: the format of candump -L, and what an independent decoder makes of a recorded boot.
#include "host/drives/bus_simulator/candump_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "host/drives/canopen/master.hpp"
#include "tests/host/drives/bus/embedded_bench.hpp"
#include "tests/host/drives/bus/fake_drive.hpp"

namespace liana::bus_simulator {
namespace {

std::string line_of(const bus::CanFrame& frame) {
  std::array<char, kLongestLogLine> line;
  return {line.data(), format_candump("can0", frame, line)};
}

TEST(CandumpLog, WritesLinesAsCandumpDoes) {
  EXPECT_EQ(line_of({0x080, 0, {}, 4000}), "(0000000000.004000) can0 080#\n");
  EXPECT_EQ(line_of({0x201, 6, {0x0F, 0, 0xDE, 0xAD, 0xBE, 0xEF}, 123456789}),
            "(0000000123.456789) can0 201#0F00DEADBEEF\n");
  EXPECT_EQ(line_of({0x1ABCDEF | bus::kCanExtendedFlag, 1, {7}, 0}), "(0000000000.000000) can0 01ABCDEF#07\n");
  EXPECT_EQ(line_of({0x701 | bus::kCanRemoteFlag, 1, {}, 0}), "(0000000000.000000) can0 701#R\n");
}

TEST(CandumpLog, SaysWhichDirectoryCannotBeWritten) {
  try {
    CandumpLog log("/no/such/directory", "can0");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/directory/can0.log"), std::string::npos);
  }
}

// Boots two fake drives over the embedded bus, stops one of them with an emergency, and leaves the logs in `directory`.
void record_a_boot(const std::string& directory) {
  const config::BusesConfig table = test::small_table();
  std::vector<canopen::ExpectedDrive> expected{test::expectation(0, 1), test::expectation(1, 2)};
  std::vector<test::FakeDrive> drives(expected.begin(), expected.end());
  test::BusThread bus_thread(table, timing::TimeMode::kFast, directory);
  int wakes = 0;
  test::PlantThread plant(bus_thread.socket_path(), [&](const wire::Wake& wake) {
    std::vector<wire::Frame> out;
    for (std::size_t i = 0; i < wake.frame_count; ++i) {
      for (const bus::CanFrame& answer : drives[wake.frame[i].bus].receive(wire::to_can_frame(wake.frame[i]))) {
        out.push_back(wire::to_wire_frame(wake.frame[i].bus, answer));
      }
    }
    for (std::size_t d = 0; d < 2 && wakes % 25 == 0; ++d) {
      for (const bus::CanFrame& heartbeat : drives[d].heartbeat())
        out.push_back(wire::to_wire_frame(static_cast<int>(d), heartbeat));
    }
    if (wakes == 150) out.push_back(wire::to_wire_frame(0, {0x081, 8, {0x50, 0x82, 0x10}, 0}));
    ++wakes;
    return out;
  });
  std::unique_ptr<bus::DriveBus> bus;
  for (int attempt = 0; !bus && attempt < 100; ++attempt) {
    try {
      bus = bus::open_drive_bus(table, timing::TimeMode::kFast, bus_thread.socket_path());
    } catch (const std::runtime_error&) {
      usleep(10000);
    }
  }
  ASSERT_TRUE(bus);
  canopen::Master master(expected, table);
  for (std::uint64_t tick = 0; tick < 200; ++tick) {
    bus->begin_tick(tick);
    bus->write_sync();
    bus->wait_feedback(2);
    for (bus::ReceivedFrame received; bus->receive(received);) master.on_frame(received.bus, received.frame, tick);
    master.step(*bus);
    for (int b = 0; b < 2 && master.boot().state() == canopen::BootState::kOperational; ++b)
      bus->send(b, {0x201U + static_cast<std::uint32_t>(b), 6, {6}, 0});
    bus->end_tick();
  }
  EXPECT_EQ(master.boot().state(), canopen::BootState::kOperational);
  EXPECT_FALSE(master.heartbeats().lost(1));
  EXPECT_EQ(master.emergencies().last_code(1), 0x8250);
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  for (int letter = 0; (letter = std::fgetc(pipe)) != EOF;) output += static_cast<char>(letter);
  return pclose(pipe) == 0 ? output : "";
}

int lines_with(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

TEST(CandumpLog, TsharkDecodesARecordedBootAsCanopenWithoutAMalformedFrame) {
  ASSERT_NE(output_of("command -v tshark"), "") << "tshark is missing: apt-get install tshark";
  const std::string directory = test::fresh_directory("tshark");
  record_a_boot(directory);
  for (const std::string name : {"can0", "can1"}) {
    const std::string log = directory + "/" + name + ".log";
    const std::string decoded = output_of("tshark -r " + log + " -d can.subdissector,canopen 2>/dev/null");
    const std::string written = test::read_file(log);
    EXPECT_EQ(lines_with(decoded, "\n"), lines_with(written, "\n"));
    EXPECT_EQ(lines_with(decoded, "CANopen"), lines_with(written, "\n"));
    EXPECT_EQ(lines_with(decoded, "Malformed"), 0);
    for (const std::string kind : {"NMT", "SYNC", "SDO", "Boot-up"}) EXPECT_GT(lines_with(decoded, kind), 0) << kind;
    EXPECT_GT(lines_with(decoded, "PDO1 (tx)"), 50);
  }
}

TEST(CandumpLog, TsharkFindsAMalformedFrameWhenThereIsOne) {
  const std::string directory = test::fresh_directory("malformed");
  {
    CandumpLog log(directory, "can0");
    log.write({0x601, 2, {0x40, 0x00}, 0});  // an SDO request cut short
  }
  EXPECT_GT(lines_with(output_of("tshark -r " + directory + "/can0.log -d can.subdissector,canopen 2>/dev/null"),
                       "Malformed"),
            0);
}

}  // namespace
}  // namespace liana::bus_simulator
