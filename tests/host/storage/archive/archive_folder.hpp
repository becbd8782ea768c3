// A folder for an archive, made for one test, and states to fill it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "host/base/json/json.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

constexpr double kPeriod_s = 0.004;
constexpr int kInterval = 5;
constexpr std::uint64_t kSecond = 250;  // ticks

inline Life life() { return {"hash", "{}", "{}", "{}", "fast", kPeriod_s, "2026-01-01T00:00:00Z", "test"}; }

class ArchiveFolder : public testing::Test {
 protected:
  ArchiveFolder() : folder_(testing::TempDir() + "liana_archive_" + std::to_string(::getpid())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ArchiveFolder() override { std::filesystem::remove_all(folder_); }

  const std::string folder_;
};

// Of an arm that always moves.
inline Json state_at(std::uint64_t tick, const std::string& name = "ENABLED") {
  const double time_s = static_cast<double>(tick) * kPeriod_s;
  Json angles = Json::array();
  for (int i = 0; i < 10; ++i) angles.push_back(std::sin(time_s + i));
  return {{"op", "state"}, {"tick", tick}, {"time_s", time_s}, {"state", name}, {"measured_js_deg", angles}};
}

inline Json verdict(std::uint64_t sequence, bool released) {
  return {{"sequence", sequence}, {"released", released},       {"code", released ? 0 : 104}, {"share", 0.5},
          {"name", "clearance"},  {"text", "12 mm too little"}, {"remedy", "go around"},      {"margin", "clearance"}};
}

inline Json event_of(std::uint64_t sequence, std::uint64_t tick) {
  return {{"op", "event"},
          {"sequence", sequence},
          {"tick", tick},
          {"kind", "stop"},
          {"number", 2},
          {"subject", "liana estop"},
          {"values", Json::object({{"drive", 3}})},
          {"text", "a stop"}};
}

}  // namespace liana::archive
