// Outputs that were not kept, made again: the core is deterministic, so that the same Inputs give them bit by bit.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace liana::recording {

class OutputsReconstruction {
 public:
  // Of a robot with this table.
  static std::unique_ptr<OutputsReconstruction> of(const std::string& robot_json);
  virtual ~OutputsReconstruction() = default;

  // An image packet of topic `tick` that this build made: the core goes on from there. Throws std::runtime_error when
  // the image makes no sense.
  virtual void go_on_from(std::string_view image_packet) = 0;
  // Of these recorded Inputs; empty where they do not follow what came before: then it takes the next image.
  virtual std::string outputs(std::string_view inputs) = 0;
  // An image packet before this tick, whose Inputs come next; empty where these do not follow.
  virtual std::string image_before(std::string_view inputs) const = 0;
};

}  // namespace liana::recording
