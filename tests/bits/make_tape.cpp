#include "tests/bits/make_tape.hpp"

#include <algorithm>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/serialise.hpp"
#include "host/storage/recording/visit.hpp"
#include "tests/benchmarks/worst_cases.hpp"
#include "tests/bits/tape.hpp"
#include "tests/bits/what_ifs.hpp"

namespace liana::bits {
namespace {

// Ticks after a change of state or of held variables: beginning, and in force.
constexpr std::uint64_t kAtChange = 0, kAfterChange = 20;

// The variables that are held; no other arm than a cable arm holds any.
std::uint32_t held_of(const cable::Outputs& outputs) { return outputs.held_mask; }
std::uint32_t held_of(const serial::Outputs&) { return 0; }

// Recorded ticks hold only what the robot has; tapes hold every place of every array.
template <class T>
std::string whole(const T& value) {
  std::string bytes;
  recording::append_serialised(bytes, value);
  return bytes;
}

struct RecordedTick {
  std::string inputs, outputs;
};

template <class Arm>
struct RecordedRun {
  std::optional<typename Arm::Table> robot;
  std::vector<RecordedTick> ticks;
};

template <class Arm>
RecordedRun<Arm> read(const std::string& directory, std::uint64_t limit) {
  RecordedRun<Arm> run;
  recording::RecordedCounts counts;
  recording::McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t, std::string_view data) {
    if (topic == recording::kStartTopic) run.robot = recording::parse_image<Arm>(data).table;
    if (topic == recording::kStartTopic) counts = recording::counts_of(*run.robot);
    if (topic == recording::kInputsTopic && run.ticks.size() < limit)
      run.ticks.push_back({whole(recording::RecordingDecoder::recorded_inputs<Arm>(data, counts)), {}});
    if (topic == recording::kOutputsTopic && !run.ticks.empty() && run.ticks.back().outputs.empty())
      run.ticks.back().outputs = whole(recording::outputs_from<Arm>(data, counts));
  };
  const recording::McapState state = recording::read_mcap(directory + "/" + recording::kRecordingFile, visitor);
  if (state != recording::McapState::kWhole || !run.robot || run.ticks.empty()) {
    throw std::runtime_error("recording " + directory +
                             ": not whole, or it does not begin at the start of a run; record it again");
  }
  return run;
}

// The same Inputs, but for the last bit of one motor position.
template <class Arm>
std::string one_bit_off(const std::string& recorded) {
  Inputs<Arm> inputs = recording::RecordingDecoder::inputs<Arm>(recorded);
  inputs.drive[0].position_counts ^= 1;
  std::string bytes;
  recording::append_serialised(bytes, inputs);
  return bytes;
}

template <class Arm>
class Maker {
 public:
  Maker(const TapeOptions& options, std::ostream& tape, std::ostream& expected, TapeSummary& summary)
      : options_(options), tape_(tape), expected_(expected), summary_(summary) {}

  void append(const RecordedRun<Arm>& run) {
    mark(kRobotMark<Arm>);
    std::string table;
    recording::append_serialised(table, *run.robot);
    tape_ << table;
    controller_.emplace(*run.robot);
    for (std::size_t i = 0; i < run.ticks.size(); ++i) {
      tick(run.ticks[i]);
      if (is_branch(run, i)) branch(run, i + 1);
    }
  }

 private:
  void mark(Mark mark) { tape_.put(static_cast<char>(mark)); }

  void tick(const RecordedTick& recorded) {
    mark(Mark::kTick);
    tape_ << (summary_.mission_ticks == options_.flip_at ? one_bit_off<Arm>(recorded.inputs) : recorded.inputs);
    expected_ << recorded.outputs;
    out_ = recording::outputs_from<Arm>(recorded.outputs);
    note_faults(out_);
    controller_->tick(recording::RecordingDecoder::inputs<Arm>(recorded.inputs));
    ++summary_.mission_ticks;
    const bool changed = out_.state != state_ || held_of(out_) != held_mask_;
    since_change_ = changed ? 0 : since_change_ + 1;
    state_ = out_.state;
    held_mask_ = held_of(out_);
  }

  bool is_branch(const RecordedRun<Arm>& run, std::size_t i) const {
    return i + 1 < run.ticks.size() &&
           (since_change_ == kAtChange || since_change_ == kAfterChange || (i + 1) % options_.apart == 0);
  }

  // What could have happened from recorded tick `next` on, as one branch each.
  void branch(const RecordedRun<Arm>& run, std::size_t next) {
    mark(Mark::kKeep);
    const Controller<Arm> kept = *controller_;
    const bool enabled = out_.state == OperatingState::kEnabled;
    for (const WhatIf<Arm>& what_if : enabled ? what_ifs_enabled<Arm>() : what_ifs_enabling<Arm>()) {
      const std::size_t drive = summary_.what_ifs++ % static_cast<std::size_t>(run.robot->drive_count());
      follow(run, next, what_if, drive);
      mark(Mark::kReturn);
      controller_ = kept;
    }
  }

  void follow(const RecordedRun<Arm>& run, std::size_t next, const WhatIf<Arm>& what_if, std::size_t drive) {
    for (std::uint32_t age = 0; age < what_if.ticks && next + age < run.ticks.size(); ++age) {
      Inputs<Arm> inputs = recording::RecordingDecoder::inputs<Arm>(run.ticks[next + age].inputs);
      what_if.change(inputs, age, drive);
      const Outputs<Arm> outputs = controller_->tick(inputs);
      note_faults(outputs);
      std::string asked, answered;
      recording::append_serialised(asked, inputs);
      recording::append_serialised(answered, outputs);
      mark(Mark::kTick);
      tape_ << asked;
      expected_ << answered;
      ++summary_.what_if_ticks;
    }
  }

  void note_faults(const Outputs<Arm>& outputs) {
    for (std::int32_t i = 0; i < outputs.faults.count; ++i)
      summary_.faults.insert(outputs.faults.fault[static_cast<std::size_t>(i)].number);
  }

  TapeOptions options_;
  std::ostream& tape_;
  std::ostream& expected_;
  TapeSummary& summary_;
  std::optional<Controller<Arm>> controller_;
  Outputs<Arm> out_{};  // of the last recorded tick
  OperatingState state_ = OperatingState::kDisabled;
  std::uint32_t held_mask_ = 0;
  std::uint64_t since_change_ = 0;
};

}  // namespace

template <class Arm>
void append_recording(const std::string& directory, const TapeOptions& options, std::ostream& tape,
                      std::ostream& expected, TapeSummary& summary) {
  Maker<Arm>(options, tape, expected, summary).append(read<Arm>(directory, options.limit));
  if (!tape || !expected) throw std::runtime_error("tape: could not be written; is the disk full?");
}

template void append_recording<cable::CableArm>(const std::string&, const TapeOptions&, std::ostream&, std::ostream&,
                                                TapeSummary&);
template void append_recording<serial::SerialArm>(const std::string&, const TapeOptions&, std::ostream&, std::ostream&,
                                                  TapeSummary&);

std::uint64_t append_cases(std::istream& lines, std::ostream& tape, std::ostream& expected) {
  std::uint64_t ticks = 0;
  const worst::Tick tick = [&](cable::Controller& controller, const cable::Inputs& inputs) {
    std::string asked, answered;
    recording::append_serialised(asked, inputs);
    const cable::Outputs outputs = controller.tick(inputs);
    recording::append_serialised(answered, outputs);
    tape.put(static_cast<char>(Mark::kTick)) << asked;
    expected << answered;
    ++ticks;
    return outputs;
  };
  std::string table;
  recording::append_serialised(table, cable::zhu2022::table());
  for (const worst::Case& one : worst::read_cases(lines)) {
    tape.put(static_cast<char>(Mark::kRobot)) << table;
    worst::play(one, worst::started(one, tick), tick);
  }
  if (!tape || !expected) throw std::runtime_error("tape: could not be written; is the disk full?");
  return ticks;
}

}  // namespace liana::bits
