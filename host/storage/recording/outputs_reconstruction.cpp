#include "host/storage/recording/outputs_reconstruction.hpp"

#include <optional>

#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/replay_core.hpp"

namespace liana::recording {
namespace {

template <class Arm>
class OfArm final : public OutputsReconstruction {
 public:
  void go_on_from(std::string_view image_packet) override {
    image_ = image_packet;
    const ControllerSnapshot<Arm> image = parse_image<Arm>(std::string_view(image_).substr(1));
    core_.emplace(image, kImagesFile);
  }
  std::string outputs(std::string_view inputs) override {
    if (core_ && !core_->is_next(inputs)) core_.reset();
    image_.clear();
    return core_ ? core_->tick(inputs) : std::string();
  }
  // Before its first tick the core is as its image says, fresh or not.
  std::string image_before(std::string_view inputs) const override {
    if (!core_ || !core_->is_next(inputs)) return {};
    std::uint64_t tick = 0;
    Reader reader(inputs);
    reader("tick", tick);
    return image_.empty() ? core_->image_packet(tick) : image_;
  }

 private:
  std::string image_;
  std::optional<ReplayCore<Arm>> core_;
};

}  // namespace

std::unique_ptr<OutputsReconstruction> OutputsReconstruction::of(const std::string& robot_json) {
  if (is_of_serial_arm(robot_json)) return std::make_unique<OfArm<serial::SerialArm>>();
  return std::make_unique<OfArm<cable::CableArm>>();
}

}  // namespace liana::recording
