#include "host/record/replay.hpp"

#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>

#include "firmware_like/controller.hpp"
#include "host/record/build_id.hpp"
#include "host/record/codec.hpp"
#include "host/record/mcap.hpp"
#include "host/record/recording.hpp"
#include "host/record/serialise.hpp"

namespace liana {

namespace {

using Images = std::map<std::uint64_t, std::string>;  // controller_image messages by next tick

class Replayer {
 public:
  Replayer(ReplayResult& result, const std::string& directory) : result_(result), directory_(directory) {}

  void take(const std::string& topic, std::string_view data) {
    if (topic == kStartTopic) start_from(data);
    if (topic == kInputsTopic) inputs(data);
    if (topic == kOutputsTopic) outputs(data);
  }
  void metadata(const std::map<std::string, std::string>& values) {
    const auto found = values.find("build_id");
    result_.same_build = result_.same_build || (found != values.end() && found->second == build_id());
  }
  bool started() const { return controller_.has_value(); }

 private:
  bool start_from(std::string_view data) {
    const ControllerImage image = parse_image(data);
    const bool usable = result_.same_build && image.controller_bytes.size() == sizeof(Controller);
    if (!image.fresh && !usable) return false;
    controller_.emplace(image.table);
    if (!image.fresh) std::memcpy(static_cast<void*>(&*controller_), image.controller_bytes.data(), sizeof(Controller));
    next_tick_ = image.next_tick;
    return true;
  }

  // After a gap, or in mid-run: goes on where there is an image.
  bool resume_at(std::uint64_t tick) {
    if (!images_) {
      images_.emplace();
      McapVisitor visitor;
      visitor.message = [this](const std::string&, std::uint32_t, std::uint64_t, std::string_view data) {
        (*images_)[parse_image(data).next_tick] = data;
      };
      if (std::filesystem::exists(directory_ + "/" + kImagesFile)) read_mcap(directory_ + "/" + kImagesFile, visitor);
    }
    const auto found = images_->find(tick);
    return found != images_->end() && start_from(found->second);
  }

  void inputs(std::string_view data) {
    expected_.clear();
    const Inputs in = RecordingDecoder::inputs(data);
    const bool follows = controller_ && in.tick == next_tick_;
    if (!follows && !resume_at(in.tick)) {
      ++result_.missing_ticks;
      return;
    }
    append_serialised(expected_, controller_->tick(in));
    next_tick_ = in.tick + 1;
  }

  void outputs(std::string_view data) {
    if (expected_.empty()) return;
    ++result_.ticks;
    if (data == expected_) return;
    if (result_.differing_ticks++ > 0) return;
    result_.first_differing_tick = next_tick_ - 1;
    std::size_t at = 0;
    while (at < data.size() && at < expected_.size() && data[at] == expected_[at]) ++at;
    result_.first_differing_field = outputs_field_at(at);
  }

  ReplayResult& result_;
  std::string directory_;
  std::optional<Images> images_;
  std::optional<Controller> controller_;
  std::uint64_t next_tick_ = 0;
  std::string expected_;
};

}  // namespace

ReplayResult replay(const std::string& directory) {
  ReplayResult result;
  Replayer replayer(result, directory);
  McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t, std::string_view data) { replayer.take(topic, data); };
  visitor.metadata = [&](const std::string&, const std::map<std::string, std::string>& values) { replayer.metadata(values); };
  result.complete = read_mcap(directory + "/" + kRecordingFile, visitor);
  if (!replayer.started())
    throw std::runtime_error(
        "recording " + directory +
        ": holds no start that this build can use: the run ended before the core started, or another build recorded it in mid-run");
  return result;
}

}  // namespace liana
