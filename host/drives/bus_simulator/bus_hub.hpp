// What the bus process holds once everybody is there: wires, participants, logs. How time passes is run_lockstep's and
// run_real's business.
#pragma once

#include <string>
#include <vector>

#include "host/base/clock/time_mode.hpp"
#include "host/drives/bus_simulator/bus_sim.hpp"
#include "host/drives/bus_simulator/candump_log.hpp"
#include "host/drives/bus_simulator/participant.hpp"

namespace liana::bus_simulator {

struct BusHubOptions {
  timing::TimeMode time_mode = timing::TimeMode::kFast;
  std::vector<WireConfig> wires;  // 1..8
  std::uint32_t period_us = 0;
  FaultScript script;
  std::string log_directory;  // empty = no logs
};

// What every participant is told when it joins.
wire::Welcome welcome_of(const BusHubOptions& options);

class BusHub final : private FrameSink {
 public:
  // Throws std::runtime_error when a log cannot be made.
  BusHub(const BusHubOptions& options, std::vector<Participant> participants);

  std::vector<Participant>& participants() { return participants_; }
  BusSim& sim() { return sim_; }
  const BusSim& sim() const { return sim_; }
  std::uint32_t period_us() const { return period_us_; }

  std::uint64_t now_ns = 0;  // since both were there
  std::uint32_t slot() const { return static_cast<std::uint32_t>(now_ns / 1000 / period_us_); }
  bool at_slot_start() const { return now_ns % (std::uint64_t{period_us_} * 1000) == 0; }

  // Waits until somebody has said something, at most `timeout_ns`.
  void wait_readable(std::uint64_t timeout_ns);
  // Reads one packet of participant `index`; true when it is a YIELD. Ends the bus when it has left or talks nonsense.
  // `block`: waits for the packet, or for a signal.
  bool read_yield(std::size_t index, bool block);
  // Puts the frames of the YIELD just read into the queues; those that do not fit go back to their sender with its next
  // WAKE.
  void queue_yield(std::size_t index);
  // When participant `index` may run at the earliest: later than now while a script pauses it.
  std::uint64_t awake_from_ns(std::size_t index) const;
  // Sends WAKE; without `block`, a full socket keeps the frames for later. Ends the bus when the participant has gone.
  void wake(std::size_t index, std::uint8_t flags, bool block);

  bool ended() const { return !end_reason_.empty(); }
  const std::string& end_reason() const { return end_reason_; }
  void end(const std::string& reason);

 private:
  void frame_ended(const EndedFrame& ended) override;
  void error_state_changed(int bus, const bus::CanFrame& error_frame) override;
  void link_changed(int bus, bool is_up) override;

  std::vector<Participant> participants_;
  BusSim sim_;
  std::vector<CandumpLog> logs_;
  std::uint32_t period_us_;
  std::string end_reason_;
};

// Virtual time (fast, paced): the wires advance when everybody has yielded. Returns when the bus has ended.
void run_lockstep(BusHub& hub, bool paced);

// The monotonic clock rules. Returns when the bus has ended.
void run_real(BusHub& hub);

}  // namespace liana::bus_simulator
