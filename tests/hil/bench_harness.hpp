// The whole bench behind a scripted master, and the files it writes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "hil/bench/bench.hpp"
#include "tests/temporary_folder.hpp"

namespace liana::bench {

inline CanFrame frame_of(std::uint8_t bus, std::uint32_t id, std::vector<std::uint8_t> bytes) {
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
  ScriptedBus(std::uint32_t slots, int counts_per_slot, std::uint8_t nodes = 15, std::uint8_t first_bus_nodes = 8)
      : slots_(slots),
        counts_per_slot_(counts_per_slot),
        nodes_(nodes),
        first_bus_nodes_(first_bus_nodes),
        position_(16, 0) {}

  bool wait(Wake& wake) override {
    if (slot_ >= slots_) return false;
    wake.slot = slot_;
    wake.now_us = 4000ULL * slot_ + 50;
    wake.frames.clear();
    for (std::uint8_t node = 1; node <= nodes_; ++node) add_for(node, wake.frames);
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
    const auto bus = static_cast<std::uint8_t>(node <= first_bus_nodes_ ? 0 : 1);
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
    frames.push_back(
        frame_of(bus, 0x200U + node,
                 {controlword, 0, static_cast<std::uint8_t>(target), static_cast<std::uint8_t>(target >> 8),
                  static_cast<std::uint8_t>(target >> 16), static_cast<std::uint8_t>(target >> 24)}));
  }

  std::uint32_t slots_;
  std::uint32_t slot_ = 0;
  int counts_per_slot_;
  std::uint8_t nodes_;
  std::uint8_t first_bus_nodes_;
  std::vector<std::int32_t> position_;
};

inline BenchOptions options_of(std::uint64_t seed) {
  BenchOptions options;
  options.robot = fixture_robot();
  options.scene = fixture_scene();
  options.buses = fixture_buses();
  options.seed = seed;
  return options;
}

inline std::string temporary(const std::string& name) { return program_folder().file(name); }

inline std::string content(const std::string& path) {
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

inline Truth read_truth(const std::string& path) {
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

}  // namespace liana::bench
