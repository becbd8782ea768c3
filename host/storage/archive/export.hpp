// An archive in formats of other tools.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "host/storage/archive/reader.hpp"

namespace liana::archive {

constexpr double kMessage_s = 0.04;  // between messages of a channel in MCAP, but for events: 25 Hz

// What time 0 of the arm is called in a file: 0, or its begin as seconds of UTC since 1970 (Life::started_utc, which is
// whole seconds). Throws std::runtime_error where the life does not say when it began.
double begin_utc_s(const Life& life);

// Nanoseconds of an arm time in such a file.
inline std::uint64_t stamp_ns(double zero_s, double time_s) {
  return static_cast<std::uint64_t>(std::llround(zero_s) * 1'000'000'000 + std::llround(time_s * 1e9));
}

// All return how many rows, messages or frames they wrote, and throw std::runtime_error with file and reason when they
// cannot; that there is nothing to write is such a reason, too. `zero_s`: 0, or begin_utc_s().

// A line for each record: tick, time, state, number of the step, and every field of the layout; what is not there is
// left empty. The column is utc_s in place of time_s where zero_s is not 0.
std::uint64_t write_csv(const Reader& reader, Span span, const std::string& file, double zero_s);

// MCAP with the schemas of Foxglove, so that its panels show the arm at once: `/scene`, `/tf` and `/joint_states` at
// 25 Hz, `/log` of events, and `/state` (plain JSON) for plots. About 2 MB a minute.
std::uint64_t write_mcap(const Reader& reader, Span span, const std::string& file, double zero_s);

// MCAP as `ros2 bag play` takes it: messages of ROS' own packages in CDR. `/robot_description` and `/tf_static` once;
// `/joint_states`, `/tf` and what CRTK names (`/measured_js`, `/setpoint_js`, `/measured_cp`, `/setpoint_cp`,
// `/goal_cp`, `/measured_cf`) at 25 Hz; `/diagnostics` of every event and of the state once a second.
std::uint64_t write_ros2(const Reader& reader, Span span, const std::string& file, double zero_s);

// The bus traffic of all buses in one candump log, in the order of its times. Runs with --record have it, and those
// that failed.
std::uint64_t write_candump(const Reader& reader, Span span, const std::string& file, double zero_s);

// Control ticks out of the ring, as `liana run --record` writes them: `folder`, which is made, gets ticks.mcap and
// snapshots.mcap, which `liana replay` runs. Outputs that are no longer kept are made again from the Inputs, and taken
// only where they match the checksum of those that were. Throws std::runtime_error when the ring holds nothing of the
// span, is damaged, or of a build with other fields, and when the folder holds a recording.
struct TicksWritten {
  std::uint64_t ticks = 0;       // that were written
  std::uint64_t made_again = 0;  // of these: their Outputs
  std::uint64_t left_out = 0;    // no Outputs are kept, and no image of this build goes before them
  std::uint64_t differing = 0;   // this core gives other Outputs than those that were
};
TicksWritten write_ticks(const Reader& reader, Span span, const std::string& folder);

}  // namespace liana::archive
