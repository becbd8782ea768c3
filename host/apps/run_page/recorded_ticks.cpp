#include "host/apps/run_page/recorded_ticks.hpp"

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/crc32.hpp"
#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/tick_packet.hpp"

namespace liana::run_page {
namespace {

using recording::kInputsTopic;
using recording::kOutputsTopic;
using recording::kStartTopic;

// Takes the recording's messages in their order: start, then Inputs and Outputs of each tick.
class Collector {
 public:
  explicit Collector(RecordedTicks& all) : all_(all) {}

  void take(std::string_view topic, std::string_view data) {
    if (topic == kStartTopic) start(data);
    if (topic == kInputsTopic) inputs(data);
    if (topic == kOutputsTopic && is_wanted_) add(data);
  }

  void finish() {
    for (const std::string& plane : planes_) all_.inputs += plane;
  }

 private:
  void start(std::string_view data) {
    std::uint64_t next_tick = 0;
    std::uint8_t is_fresh = 0;
    recording::Reader reader(data);
    reader("next_tick", next_tick);
    reader("fresh", is_fresh);
    if (is_fresh == 0 || !all_.start.empty()) return;  // what goes on in mid-run needs the build that recorded it
    all_.start = data;
    expected_tick_ = next_tick;
  }

  void inputs(std::string_view data) {
    ++all_.recorded;
    std::uint64_t tick = 0;
    std::uint32_t lost_ticks = 0;
    recording::Reader head(data);
    head("tick", tick);
    head("lost_ticks", lost_ticks);
    has_gap_ = has_gap_ || all_.start.empty() || tick != expected_tick_ + lost_ticks || data.size() > UINT16_MAX;
    expected_tick_ = tick + 1;
    is_wanted_ = !has_gap_ && all_.ticks < kMaxPageTicks;
    if (is_wanted_) inputs_ = data;
  }

  // The tick whose Outputs these are is whole.
  void add(std::string_view outputs) {
    recording::Writer(all_.sizes)("size", static_cast<std::uint16_t>(inputs_.size()));
    recording::Writer(all_.checksums)("crc", recording::crc_of(outputs));
    if (planes_.size() < inputs_.size()) planes_.resize(inputs_.size());
    before_.resize(planes_.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const auto now = static_cast<std::uint8_t>(inputs_[i]);
      planes_[i].push_back(static_cast<char>(now - before_[i]));
      before_[i] = now;
    }
    ++all_.ticks;
    is_wanted_ = false;
  }

  RecordedTicks& all_;
  std::string inputs_;                // of this tick
  std::vector<std::string> planes_;   // byte i of all ticks, as differences
  std::vector<std::uint8_t> before_;  // each byte as it was last
  std::uint64_t expected_tick_ = 0;
  bool has_gap_ = false, is_wanted_ = false;
};

}  // namespace

RecordedTicks recorded_ticks_in(const std::string& folder, bool is_serial) {
  RecordedTicks all;
  all.is_serial = is_serial;
  const std::string file = folder + "/" + recording::kRecordingFile;
  if (!std::filesystem::exists(file)) return all;
  Collector collector(all);
  recording::McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t, std::string_view data) {
    collector.take(topic, data);
  };
  if (recording::read_mcap(file, visitor) == recording::McapState::kDamaged)
    throw std::runtime_error("'" + file + "': damaged: its bytes do not match their checksum; take a good copy");
  collector.finish();
  return all;
}

}  // namespace liana::run_page
