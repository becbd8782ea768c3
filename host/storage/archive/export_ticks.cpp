#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "host/storage/archive/export.hpp"
#include "host/storage/archive/ring_reader.hpp"
#include "host/storage/recording/build_id.hpp"
#include "host/storage/recording/crc32.hpp"
#include "host/storage/recording/outputs_reconstruction.hpp"
#include "host/storage/recording/recording.hpp"

namespace liana::archive {
namespace {

namespace fs = std::filesystem;

using Images = std::map<std::uint64_t, std::string>;  // packets by next tick

constexpr double kBack_s = 70.0;  // so far before a tick there is an image, unless one came late

// The images that a span can begin from. Those of another build are of no use: its core may tick otherwise.
Images images_of(const RingReader& ring, Span span, double period_s) {
  const auto back = static_cast<std::uint64_t>(kBack_s / period_s);
  Images images;
  RingVisitor visitor;
  visitor.image = [&](const RingAbout& about, std::uint64_t next_tick, const std::string& packet) {
    if (about.build_id == recording::build_id() && next_tick <= span.last) images[next_tick] = packet;
  };
  ring.visit({span.first - std::min(span.first, back), span.last}, visitor);
  return images;
}

// Takes ticks from before the span on, until the core is where the span begins, and writes those in it.
class TicksWriter {
 public:
  TicksWriter(const Reader& reader, Span span, std::string folder, Images images)
      : life_(reader.life()),
        span_(span),
        folder_(std::move(folder)),
        images_(std::move(images)),
        core_(recording::OutputsReconstruction::of(life_.robot)) {}

  void take(const RingAbout& about, const RingTick& tick) {
    const auto image = images_.find(tick.tick);
    if (image != images_.end()) core_->go_on_from(image->second);
    if (tick.tick >= span_.first) begin_at(about, tick);
    RingTick whole = tick;
    const std::string again = about.build_id == recording::build_id() ? core_->outputs(tick.inputs) : std::string();
    if (tick.tick < span_.first) return;
    if (!again.empty() && recording::crc_of(again) != tick.outputs_crc) ++result_.differing;
    if (whole.outputs.empty() && recording::crc_of(again) == tick.outputs_crc) {
      whole.outputs = again;
      ++result_.made_again;
    }
    write(about, whole);
  }
  TicksWritten finish() {
    if (recording_) recording_->finish();
    return result_;
  }

 private:
  // Where the recording begins, and where it goes on after a gap, a replay needs an image.
  void begin_at(const RingAbout& about, const RingTick& tick) {
    if (has_image_ && next_tick_ == tick.tick) return;
    const std::string image = core_->image_before(tick.inputs);
    if (image.empty()) return;
    make_recording(about);
    recording_->take(image);
    has_image_ = true;
  }
  void make_recording(const RingAbout& about) {
    if (recording_) return;
    fs::create_directories(folder_);
    recording_.emplace(folder_, recording::RecordingInfo{life_.config_hash, life_.robot, life_.scene, life_.buses,
                                                         life_.time_mode, life_.period_s, about.build_id});
  }
  void write(const RingAbout& about, const RingTick& tick) {
    if (tick.outputs.empty()) {
      ++result_.left_out;
      return;
    }
    make_recording(about);
    recording_->take({0, about.counts, tick.inputs, tick.outputs});
    next_tick_ = tick.tick + 1;
    ++result_.ticks;
  }

  const Life life_;
  const Span span_;
  const std::string folder_;
  const Images images_;
  std::unique_ptr<recording::OutputsReconstruction> core_;
  std::optional<recording::Recording> recording_;
  std::uint64_t next_tick_ = 0;
  bool has_image_ = false;
  TicksWritten result_;
};

}  // namespace

TicksWritten write_ticks(const Reader& reader, Span span, const std::string& folder) {
  if (fs::exists(folder + "/" + recording::kRecordingFile))
    throw std::runtime_error(folder + ": holds a recording already; name another folder");
  const RingReader ring(reader.folder(), reader.life_number());
  const auto recorded = ring.recorded();
  if (!recorded || recorded->last < span.first || recorded->first > span.last)
    throw std::runtime_error(reader.folder() + ": its ring holds no ticks of this time; liana log verify says which");
  Images images = images_of(ring, span, reader.life().period_s);
  auto begin = images.upper_bound(std::max(span.first, recorded->first));
  const std::uint64_t first = begin == images.begin() ? span.first : std::prev(begin)->first;
  TicksWriter writer(reader, span, folder, std::move(images));
  RingVisitor visitor;
  visitor.tick = [&](const RingAbout& about, const RingTick& tick) {
    if (about.widths != recording::field_widths(recording::is_of_serial_arm(reader.life().robot), about.counts))
      throw std::runtime_error(reader.folder() + ": its ticks have other fields than those of this build; the build " +
                               about.build_id + " reads them");
    writer.take(about, tick);
  };
  ring.visit({std::min(first, span.first), span.last}, visitor);
  return writer.finish();
}

}  // namespace liana::archive
