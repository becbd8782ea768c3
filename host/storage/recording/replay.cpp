#include "host/storage/recording/replay.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>

#include "host/storage/recording/build_id.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/replay_core.hpp"
#include "host/storage/recording/serialise.hpp"

namespace liana::recording {

namespace {

using Images = std::map<std::uint64_t, std::string>;  // controller_snapshot messages by next tick

// Throws std::runtime_error when a byte of the file is not as it was written; true when the file is whole, false when
// it was cut short.
bool require_undamaged(const std::string& file, const McapVisitor& visitor = {}) {
  const McapState state = read_mcap(file, visitor);
  if (state == McapState::kDamaged) {
    throw std::runtime_error(
        "recording " + file +
        ": damaged: its bytes do not match the checksum they were written with; take a good copy of the file");
  }
  return state == McapState::kWhole;
}

template <class Arm>
class Replayer {
 public:
  Replayer(ReplayResult& result, const std::string& directory) : result_(result), directory_(directory) {}

  void take(const std::string& topic, std::string_view data) {
    if (topic == kStartTopic) start_from(data, directory_ + "/" + kRecordingFile);
    if (topic == kInputsTopic) inputs(data);
    if (topic == kOutputsTopic) outputs(data);
  }
  void metadata(const std::map<std::string, std::string>& values) {
    const auto found = values.find("build_id");
    if (found == values.end()) return;
    result_.recorded_by = found->second;
    result_.same_build = found->second == build_id();
  }
  bool started() const { return core_.has_value(); }

 private:
  bool start_from(std::string_view data, const std::string& file) {
    const ControllerSnapshot<Arm> image = parse_image<Arm>(data, file);
    if (!image.fresh && !result_.same_build) return false;
    core_.emplace(image, file);
    return true;
  }

  void read_images(const std::string& file) {
    images_.emplace();
    if (!std::filesystem::exists(file)) return;
    require_undamaged(file);
    McapVisitor visitor;
    visitor.message = [this, &file](const std::string&, std::uint32_t, std::uint64_t, std::string_view data) {
      (*images_)[parse_image<Arm>(data, file).next_tick] = data;
    };
    read_mcap(file, visitor);
  }

  // After a gap, or in mid-run: goes on where there is an image.
  bool resume_at(std::uint64_t tick) {
    const std::string file = directory_ + "/" + kImagesFile;
    if (!images_) read_images(file);
    const auto found = images_->find(tick);
    return found != images_->end() && start_from(found->second, file);
  }

  void inputs(std::string_view data) {
    expected_.clear();
    std::uint64_t tick = 0;
    Reader head(data);
    head("tick", tick);
    if (!(core_ && core_->is_next(data)) && !resume_at(tick)) {
      ++result_.missing_ticks;
      return;
    }
    expected_ = core_->tick(data);
  }

  void outputs(std::string_view data) {
    if (expected_.empty()) return;
    ++result_.ticks;
    if (data == expected_) return;
    if (result_.differing_ticks++ > 0) return;
    result_.first_differing_tick = core_->next_tick() - 1;
    std::size_t at = 0;
    while (at < data.size() && at < expected_.size() && data[at] == expected_[at]) ++at;
    result_.first_differing_field = outputs_field_at<Arm>(at, core_->counts());
  }

  ReplayResult& result_;
  std::string directory_;
  std::optional<Images> images_;
  std::optional<ReplayCore<Arm>> core_;
  std::string expected_;
};

// The core again over the whole file.
template <class Arm>
void replay_as(const std::string& directory, ReplayResult& result) {
  Replayer<Arm> replayer(result, directory);
  McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t, std::string_view data) {
    replayer.take(topic, data);
  };
  visitor.metadata = [&](const std::string&, const std::map<std::string, std::string>& values) {
    replayer.metadata(values);
  };
  read_mcap(directory + "/" + kRecordingFile, visitor);
  if (!replayer.started())
    throw std::runtime_error("recording " + directory +
                             ": holds no start that this build can use: the run ended before the core started, or "
                             "another build recorded it in mid-run");
}

}  // namespace

ReplayResult replay(const std::string& directory) {
  ReplayResult result;
  std::string robot_json = "{}";
  McapVisitor head;
  head.metadata = [&](const std::string&, const std::map<std::string, std::string>& values) {
    if (const auto robot = values.find("robot"); robot != values.end()) robot_json = robot->second;
  };
  result.complete = require_undamaged(directory + "/" + kRecordingFile, head);
  result.is_serial = is_of_serial_arm(robot_json);
  if (result.is_serial) {
    replay_as<serial::SerialArm>(directory, result);
  } else {
    replay_as<cable::CableArm>(directory, result);
  }
  return result;
}

}  // namespace liana::recording
