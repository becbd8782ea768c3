// The recording of a run. DIR/ticks.mcap (channels start, inputs, outputs) holds all that a replay needs, and is the
// same byte for byte when a run is repeated. DIR/snapshots.mcap (channel controller_snapshot), which makes it seekable,
// is so, too: a Controller is written field by field.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

constexpr const char* kRecordingFile = "ticks.mcap";
constexpr const char* kStartTopic = "start";
constexpr const char* kInputsTopic = "inputs";
constexpr const char* kOutputsTopic = "outputs";
constexpr const char* kImageTopic = "controller_snapshot";

// What a recording says about its run.
struct RecordingInfo {
  std::string config_hash, robot_json, scene_json, buses_json, time_mode;
  double period_s = 0.0;
  std::string recorded_by{};  // build id of the core that ticked; empty: this one
};

class Recording {
 public:
  // Creates both files (DIR must exist); throws std::runtime_error.
  Recording(const std::string& directory, const RecordingInfo& info);
  // Takes one binary packet of the API topic `tick`.
  void take(std::string_view packet);
  // The same of a tick that was taken apart.
  void take(const TickParts& parts);
  // Writes how many ticks there are and were lost, and ends the files.
  void finish();
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  void write(McapWriter& file, std::uint16_t channel, std::uint64_t tick, std::string_view data);
  template <class Arm>
  void take_image(std::string_view image);
  template <class Arm>
  void add_tick_channels(const RecordedCounts& counts);

  McapWriter ticks_file_, images_file_;
  double period_s_;
  bool is_serial_;
  std::uint16_t start_, image_, inputs_ = 0, outputs_ = 0;
  std::uint64_t ticks_ = 0, dropped_ = 0;
};

// Which kind of arm a recording is of, by the table of its robot.
bool is_of_serial_arm(const std::string& robot_json);

}  // namespace liana::recording
