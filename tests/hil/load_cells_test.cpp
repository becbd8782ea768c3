// Load cells as nodes on the bench's bus: what they send of tensions, and with each fault. req:A10
#include "hil/bench/load_cells.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace liana::bench {
namespace {

constexpr LoadCellParams kQuiet{.noise_N = 0.0};

// A node with the cells of cables 2 and 3; the second has a zero of 5 N.
BusesConfig buses() {
  BusesConfig buses;
  buses.newtons_per_step = 0.05;
  buses.load_cells = {{40, 1, {1, 2}, {0.0, 5.0}}};
  return buses;
}

FaultConfig fault_of(FaultKind kind, const char* name, std::size_t cable) {
  FaultConfig fault;
  fault.kind = kind;
  fault.name = name;
  fault.drives = {cable};
  fault.at_slot = 0;
  fault.parameters.tension_N = -30.0;
  return fault;
}

// The two readings of one slot, in newtons; empty where the node says nothing.
class OnBus {
 public:
  explicit OnBus() : cells_(buses(), false, 1, kQuiet) { slot(0.0, 0.0); }
  void suffer(const std::vector<FaultConfig>& faults) {
    cells_.refuse_faults_of_others(faults);
    cells_.suffer(faults, [](std::size_t) { return true; });
  }
  std::vector<double> slot(double second_N, double third_N) {
    CanFrame sync;
    sync.bus = 1;
    sync.id = 0x080;
    FrameList out;
    cells_.exchange({sync}, now_us_ += 4000, {0.0, second_N, third_N}, out);
    std::vector<double> read;
    for (const CanFrame& frame : out) {
      if (frame.id != 0x180 + 40) continue;
      for (std::size_t i = 0; i + 1 < frame.length; i += 2)
        read.push_back(0.05 * static_cast<std::int16_t>(frame.data[i] | frame.data[i + 1] << 8));
    }
    return read;
  }

 private:
  LoadCells cells_;
  std::uint64_t now_us_ = 0;
};

TEST(LoadCells, OneFrameASyncHasTheTensionOfEveryCableInSteps) {
  OnBus bus;
  const std::vector<double> read = bus.slot(40.0, 100.0);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_DOUBLE_EQ(read[0], 40.0);
  EXPECT_DOUBLE_EQ(read[1], 105.0) << "with its zero";
}

TEST(LoadCells, EachFaultSpoilsItsOwnCable) {
  using enum FaultKind;
  OnBus bus;
  bus.slot(40.0, 100.0);
  bus.suffer({fault_of(kLoadCellFailed, "load_cell_failed", 1)});
  EXPECT_DOUBLE_EQ(bus.slot(41.0, 101.0)[0], 0.05 * -32768);
  bus.suffer({fault_of(kLoadCellStuck, "load_cell_stuck", 2)});
  EXPECT_DOUBLE_EQ(bus.slot(42.0, 102.0)[1], 106.0) << "what it read last";
  EXPECT_DOUBLE_EQ(bus.slot(42.0, 103.0)[0], 42.0);
  bus.suffer({fault_of(kLoadCellOff, "load_cell_off", 1)});
  EXPECT_DOUBLE_EQ(bus.slot(43.0, 103.0)[0], 13.0);
  bus.suffer({fault_of(kLoadCellSilent, "load_cell_silent", 1)});
  EXPECT_TRUE(bus.slot(43.0, 103.0).empty());
  bus.suffer({});
  EXPECT_DOUBLE_EQ(bus.slot(44.0, 104.0)[0], 44.0);
}

TEST(LoadCells, AFaultOfACellThatIsNotThereIsRefused) {
  OnBus bus;
  EXPECT_THROW(bus.suffer({fault_of(FaultKind::kLoadCellStuck, "load_cell_stuck", 0)}), std::runtime_error);
  EXPECT_NO_THROW(bus.suffer({fault_of(FaultKind::kSlack, "slack", 0)}));
}

}  // namespace
}  // namespace liana::bench
