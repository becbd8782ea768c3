// The twin: a copy of the Controller that runs ahead of the arm (design: what crosses, twin timing).
#pragma once

#include <span>
#include <vector>

#include "firmware_like/controller.hpp"
#include "firmware_like/controller_io.hpp"
#include "host/verify/release.hpp"

namespace liana {

// What the real-time thread publishes at the start of each command interval.
struct TwinImage {
  std::uint64_t next_tick = 0;  // the tick that the copy computes next
  bool fresh = true;            // the copy has not computed any tick yet
  Controller controller;
  Inputs last_inputs{};
  Outputs last_outputs{};
};

// What the twin predicts for one candidate.
struct Prediction {
  std::vector<Outputs> ticks;       // the candidate's interval, then the stop after it
  std::size_t command_ticks = 0;    // of these belong to the candidate's interval
  bool comes_to_rest = false;       // within the allowed number of stop ticks
  std::uint64_t faults_before = 0;  // latched at the start
};

class Twin {
 public:
  explicit Twin(const RobotTable& table) : table_(table) {}
  // Advances a copy through what is already released, then through the candidate, then through the stop that follows
  // when nothing else comes; at most `max_stop_ticks` of it.
  Prediction run(const TwinImage& start, std::span<const Telecommand> released, const Candidate& candidate,
                 std::size_t max_stop_ticks) const;

 private:
  RobotTable table_;
};

}  // namespace liana
