#include "host/storage/archive/ring.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "host/storage/archive/telemetry_files.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/tick_packet.hpp"

namespace liana::archive {
namespace {

constexpr double kBlock_s = 1.0;
constexpr double kAlarm_s = 3600.0;  // a disk that stays full is said again
constexpr const char* kTicks = "ticks";

}  // namespace

Ring::Ring(std::string folder, std::uint64_t life, const Life& about, RingLimits limits,
           std::function<void(const Gap&)> on_gap)
    : folder_(std::move(folder)),
      life_(life),
      period_s_(about.period_s),
      is_serial_(recording::is_of_serial_arm(about.robot)),
      limits_(limits),
      on_gap_(std::move(on_gap)) {}

std::uint64_t Ring::ticks_in(double time_s) const {
  return static_cast<std::uint64_t>(std::llround(time_s / period_s_));
}

void Ring::take(std::string_view packet) {
  recording::tick_packet_kind(packet) == recording::TickPacket::kImage ? take_image(packet) : take_tick(packet);
}

// Not every image: a replay of a minute takes a second.
void Ring::take_image(std::string_view packet) {
  std::uint64_t next_tick = 0;
  recording::Reader reader(packet.substr(1));
  reader("next_tick", next_tick);
  if (image_tick_ && next_tick < *image_tick_ + ticks_in(limits_.image_s)) return;
  image_tick_ = next_tick;
  image_ = packet;
}

void Ring::take_tick(std::string_view packet) {
  const recording::TickParts parts = recording::split_tick_packet(packet);
  if (!block_) {
    about_ = ring_about(is_serial_, parts.counts);
    block_.emplace(about_.widths);
  }
  look_for_gap(parts.inputs);
  if (!block_->is_empty() && tick_of(parts.inputs) >= block_->first_tick() + ticks_in(kBlock_s)) flush();
  block_->add(parts.inputs, parts.outputs);
  next_tick_ = block_->last_tick() + 1;
  ++ticks_;
}

// Deadlines that were lost are no gap: the core had no tick. After a gap a replay needs an image.
void Ring::look_for_gap(std::string_view inputs) {
  std::uint64_t tick = 0;
  std::uint32_t lost_ticks = 0;
  recording::Reader reader(inputs);
  reader("tick", tick);
  reader("lost_ticks", lost_ticks);
  if (!next_tick_ || tick <= *next_tick_ + lost_ticks) return;
  const std::uint64_t missing = tick - lost_ticks - *next_tick_;
  flush();
  image_tick_.reset();
  missing_ += missing;
  on_gap_({*next_tick_, tick - lost_ticks - 1, kTicks, missing, "read too slowly"});
}

// A block that cannot be written is lost: nobody waits for a disk.
void Ring::flush() {
  if (!block_ || block_->is_empty()) return;
  try {
    if (make_room()) {
      write();
      end_of_loss();
    } else {
      lose_block(kDiskFull);
    }
  } catch (const std::runtime_error& error) {
    inputs_.reset();
    outputs_.reset();
    lose_block(has_room() ? error.what() : kDiskFull);
  }
  block_->clear();
}

// Inputs last: Outputs without them are no harm.
void Ring::write() {
  open_files(block_->first_tick());
  outputs_->write(kRingOutputsTopic, block_->first_tick(), block_->outputs_message());
  if (!image_.empty()) inputs_->write(kRingImageTopic, block_->first_tick(), image_);
  image_.clear();
  inputs_->write(kRingInputsTopic, block_->first_tick(), block_->inputs_message());
}

void Ring::open_files(std::uint64_t tick) {
  const auto is_over = [&](const std::unique_ptr<RingSegment>& file, double length_s) {
    return !file || tick >= file->first_tick() + ticks_in(length_s);
  };
  const auto open = [&](std::unique_ptr<RingSegment>& file, RingKind kind) {
    if (file) file->finish();
    file = std::make_unique<RingSegment>(ring_path(folder_, kind, life_, tick), tick, period_s_, about_);
  };
  const bool next_inputs = is_over(inputs_, limits_.inputs_file_s);
  const bool next_outputs = is_over(outputs_, limits_.outputs_file_s);
  if (next_inputs) open(inputs_, RingKind::kInputs);
  if (next_inputs && image_.empty()) image_tick_.reset();  // every file shall have an image of its own
  if (next_outputs) open(outputs_, RingKind::kOutputs);
  if (!next_inputs && !next_outputs) return;
  keep_windows(true);
  keep_to_limits(folder_, limits_, period_s_, life_, tick);
  std::erase_if(windows_, [&](const Span& w) { return w.last + ticks_in(limits_.outputs_file_s) < tick; });
}

void Ring::keep_windows(bool is_open) {
  for (const Span& window : windows_) keep_outputs(folder_, life_, window, ticks_in(limits_.outputs_file_s), is_open);
}

void Ring::keep_around(std::uint64_t tick) {
  const std::uint64_t around = ticks_in(limits_.around_s);
  const Span window{tick - std::min(tick, around), tick + around};
  if (!windows_.empty() && tick >= windows_.back().first && tick <= windows_.back().last) {
    windows_.back().last = std::max(windows_.back().last, window.last);
    return;
  }
  windows_.push_back(window);
  keep_outputs(folder_, life_, window, ticks_in(limits_.outputs_file_s), outputs_ != nullptr);
}

bool Ring::has_room() const {
  std::error_code unknown;
  const std::filesystem::space_info space = std::filesystem::space(folder_, unknown);
  return unknown || space.available >= limits_.leave_bytes;
}

// The oldest files go, in the end those that are written: what is left of the disk is for commands and events.
bool Ring::make_room() {
  if (has_room()) return true;
  if (block_->first_tick() >= next_alarm_tick_) {
    next_alarm_tick_ = block_->first_tick() + ticks_in(kAlarm_s);
    const std::vector<RingFile> files = ring_files(folder_);
    if (!files.empty()) on_gap_({files[0].first_tick, files[0].first_tick, kTicks, 0, kRoomOnDisk});
  }
  while (!has_room() && drop_oldest_ring_file(folder_, inputs_ || outputs_)) {
  }
  if (has_room()) return true;
  if (inputs_) inputs_->finish();
  if (outputs_) outputs_->finish();
  inputs_.reset();
  outputs_.reset();
  image_tick_.reset();
  while (!has_room() && drop_oldest_ring_file(folder_, false)) {
  }
  return has_room();
}

// Said as it begins, and once more with all the rest when it is over. After it a replay needs an image.
void Ring::lose_block(const std::string& why) {
  image_tick_.reset();
  missing_ += block_->count();
  if (!losing_) {
    on_gap_({block_->first_tick(), block_->last_tick(), kTicks, block_->count(), why});
    losing_ = Gap{block_->last_tick() + 1, block_->last_tick(), kTicks, 0, why};
    return;
  }
  losing_->last_tick = block_->last_tick();
  losing_->count += block_->count();
}

void Ring::end_of_loss() {
  if (losing_ && losing_->count > 0) on_gap_(*losing_);
  losing_.reset();
}

void Ring::finish() {
  flush();
  end_of_loss();
  if (inputs_) inputs_->finish();
  if (outputs_) outputs_->finish();
  inputs_.reset();
  outputs_.reset();
  keep_windows(false);
}

}  // namespace liana::archive
