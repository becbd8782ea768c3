// One file of the ring while it is written: every message is whole on the disk, or not there.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "host/storage/recording/field_widths.hpp"
#include "host/storage/recording/mcap.hpp"

namespace liana::archive {

constexpr const char* kRingEncoding = "liana-ring-1";
constexpr const char* kRingInputsTopic = "inputs";
constexpr const char* kRingOutputsTopic = "outputs";
constexpr const char* kRingImageTopic = "controller_snapshot";  // packets of lianad's topic `tick`, as they came
constexpr const char* kRingMetadata = "ring";

using Texts = std::map<std::string, std::string>;

// What a file says of the ticks in it: enough to take them apart in another build, too.
struct RingAbout {
  std::string build_id;  // of the core that ticked
  recording::RecordedCounts counts{};
  recording::FieldWidths widths{};
};
// Throws std::runtime_error when the metadata of a file are not those of a ring.
RingAbout ring_about(const Texts& metadata);
// Of ticks that this build makes.
RingAbout ring_about(bool is_serial, const recording::RecordedCounts& counts);

class RingSegment {
 public:
  // Creates the file. Throws std::runtime_error.
  RingSegment(const std::string& path, std::uint64_t first_tick, double period_s, const RingAbout& about);
  // A file that was not finished keeps all that was written.
  ~RingSegment();
  RingSegment(const RingSegment&) = delete;
  RingSegment& operator=(const RingSegment&) = delete;

  std::uint64_t first_tick() const { return first_tick_; }
  // Hands it to the system, so that it outlives this process. Throws std::runtime_error when the disk refuses it.
  void write(const char* topic, std::uint64_t tick, std::string_view data);
  // Ends the file properly. Throws std::runtime_error.
  void finish();

 private:
  std::string path_;
  std::uint64_t first_tick_;
  double period_s_;
  std::unique_ptr<recording::McapWriter> file_;
  std::map<std::string, std::uint16_t> channels_;
  std::uint64_t good_bytes_ = 0;
};

}  // namespace liana::archive
