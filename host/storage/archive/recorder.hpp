// The flight recorder: what lianad says, into the archive of a run. Events and refused commands are durable before the
// next message is taken; released commands and telemetry within a second.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "host/api/telemetry/layout.hpp"
#include "host/base/event/standing.hpp"
#include "host/base/json/json.hpp"
#include "host/storage/archive/ledger.hpp"
#include "host/storage/archive/telemetry_files.hpp"

namespace liana::archive {

class Recorder {
 public:
  // Begins a life in the archive of the folder, which must exist, or goes on with one whose recorder was cut off
  // (Ledger::begin); what happened since then and before the next state is a gap. Throws DatabaseError.
  // `on_alarm` hears what a full disk takes and what the ring misses, in words for an operator, and of how many.
  using OnAlarm = std::function<void(const std::string& text, std::uint64_t count)>;
  Recorder(
      const std::string& folder, const Life& life, int interval_ticks, TelemetryLimits limits = {},
      std::uint64_t next_event = 0, OnAlarm on_alarm = [](const std::string&, std::uint64_t) {});

  // One message of lianad: `state`, `event` or `events_lost`; others are ignored. Throws JsonError for one that is not
  // as docs/reference/api.md says, DatabaseError when the archive cannot be written for another reason than a full
  // disk.
  void take(Json message);
  // Something else of the run that is not there (host/storage/archive/ring.hpp): said on standard error, and kept.
  void note_gap(const Gap& gap);
  // Writes what waits and leaves plain files.
  void finish();

  std::uint64_t life() const { return begun_.life; }
  std::uint64_t states() const { return states_; }
  // Events, commands and gaps that outlive loss of power; and those that a full disk took.
  std::uint64_t durable() const { return ledger_.durable(); }
  std::uint64_t lost() const { return ledger_.lost(); }
  // A disk that was full has cost telemetry, or made events and commands wait.
  bool was_disk_full() const { return was_disk_full_; }

 private:
  void take_state(Json state);
  void take_verdict(std::uint64_t tick, const Json& verdict);
  void take_facts(std::uint64_t tick, Json state);
  void commit();

  void go_on_after_cut();
  struct Alarm {
    std::string text;
    std::uint64_t count = 0;
    bool is_for_lianad = false;
  };
  void say(const Alarm& alarm, const std::string& more);
  void say_due(bool all);

  const std::string folder_;
  const OnAlarm on_alarm_;
  Ledger ledger_;
  const Ledger::Begun begun_;
  const double period_s_;
  event::Standing<Alarm> standing_;  // of gaps; by ticks
  const std::uint64_t interval_ticks_, min_ticks_;
  TelemetryFiles telemetry_;
  std::optional<telemetry::Layout> layout_;
  Json facts_;
  std::uint64_t states_ = 0, last_tick_ = 0, last_record_ = 0, last_commit_ = 0;
  std::uint32_t records_ = 0, facts_number_ = 0;
  std::uint64_t command_ = 0;
  const char* why_missing_ = "read too slowly";  // of states
  bool must_commit_ = false, is_alarmed_ = false, was_disk_full_ = false;
};

}  // namespace liana::archive
