#include "host/storage/archive/recorder.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include "host/api/telemetry/record.hpp"
#include "host/base/event/event_json.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/ring_files.hpp"

namespace liana::archive {
namespace {

constexpr double kRecord_s = 0.02;  // telemetry is not denser
constexpr double kCommit_s = 1.0;   // for what need not be durable at once
constexpr double kOver_s = 10.0;    // an alarm that did not come for so long is over
constexpr double kAgain_s = 60.0;   // one that stands is said so often

std::uint64_t ticks_of(double seconds, double period_s) {
  return static_cast<std::uint64_t>(std::llround(seconds / period_s));
}

}  // namespace

Recorder::Recorder(const std::string& folder, const Life& life, int interval_ticks, TelemetryLimits limits,
                   std::uint64_t next_event, OnAlarm on_alarm)
    : folder_(folder),
      on_alarm_(std::move(on_alarm)),
      ledger_(folder),
      begun_(ledger_.begin(life, next_event)),
      period_s_(life.period_s),
      standing_({ticks_of(kOver_s, life.period_s), ticks_of(kAgain_s, life.period_s)}),
      interval_ticks_(static_cast<std::uint64_t>(interval_ticks)),
      min_ticks_(ticks_of(kRecord_s, life.period_s)),
      telemetry_(
          folder, begun_.life, life.period_s, limits, [this](const Gap& gap) { note_gap(gap); },
          [this](std::uint64_t first_tick) { ledger_.add_telemetry_file(first_tick); }) {
  if (begun_.goes_on) go_on_after_cut();
}

// Numbers of records and facts go on, too.
void Recorder::go_on_after_cut() {
  const Reader before(folder_);
  const auto recorded = before.recorded();
  if (!recorded) return;
  const std::vector<std::string> newest = before.telemetry({recorded->last, recorded->last});
  if (newest.empty()) return;
  const telemetry::Header header = telemetry::header_of(newest.back());
  records_ = header.sequence;
  facts_number_ = header.facts;
  last_tick_ = last_record_ = recorded->last;
  states_ = 1;
  why_missing_ = "the recorder was not there";
}

void Recorder::take(Json message) {
  const std::string op = message.value("op", "");
  if (op == "state") return take_state(std::move(message));
  if (op == "event") {
    ledger_.add(event::event_from_json(message));
    must_commit_ = true;
  }
  if (op == "events_lost")
    note_gap(
        {last_tick_, last_tick_, "events", message.at("count"), "lianad no longer had them when they were asked for"});
  if (must_commit_) commit();
}

void Recorder::take_state(Json state) {
  const std::uint64_t tick = state.at("tick");
  if (!layout_) {
    layout_ = telemetry::layout_of(state);
    ledger_.set_layout(telemetry::to_json(*layout_));
    telemetry_.set_layout(*layout_);
  }
  if (states_ > 0 && tick > last_tick_ + interval_ticks_) {
    const std::uint64_t missing = (tick - last_tick_) / interval_ticks_ - 1;
    note_gap({last_tick_ + interval_ticks_, tick - interval_ticks_, "states", missing, why_missing_});
  }
  if (state.contains("verdict")) take_verdict(tick, state.at("verdict"));
  if (records_ == 0 || tick >= last_record_ + min_ticks_) {
    std::string record = telemetry::encode(*layout_, state, ++records_, facts_number_);
    take_facts(tick, std::move(state));
    telemetry::set_facts(record, facts_number_);
    telemetry_.add(tick, record);
    last_record_ = tick;
  }
  ++states_;
  last_tick_ = tick;
  why_missing_ = "read too slowly";
  if (tick >= last_commit_ + ticks_of(kCommit_s, period_s_)) must_commit_ = true;
  if (must_commit_) commit();
}

void Recorder::take_facts(std::uint64_t tick, Json state) {
  Json facts = telemetry::facts_of(std::move(state));
  if (!facts_.is_null() && facts == facts_) return;
  facts_ = std::move(facts);
  telemetry_.set_facts({tick, ++facts_number_, facts_});
}

// Of each command once; a state repeats the last one.
void Recorder::take_verdict(std::uint64_t tick, const Json& verdict) {
  const std::uint64_t sequence = verdict.value("sequence", std::uint64_t{0});
  if (sequence == 0 || sequence == command_) return;
  command_ = sequence;
  const bool released = verdict.value("released", false);
  ledger_.add(Command{sequence, tick, released, verdict.value("code", 0), verdict.value("share", 0.0),
                      verdict.value("name", ""), verdict.value("text", ""), verdict.value("remedy", ""),
                      verdict.value("margin", "")});
  must_commit_ = must_commit_ || !released;
}

void Recorder::note_gap(const Gap& gap) {
  const std::string text = gap.what + " of ticks " + std::to_string(gap.first_tick) + " to " +
                           std::to_string(gap.last_tick) + " are missing: " + gap.text;
  const bool is_of_disk = gap.text == kDiskFull || gap.text == kRoomForRows || gap.text == kRoomOnDisk;
  const Alarm alarm{text, gap.count, is_of_disk || gap.what == "ticks"};
  const std::string key = gap.what + ": " + gap.text;
  if (auto* counted = standing_.take(key, gap.what, last_tick_, 1)) {
    counted->what = {text, (counted->times == 1 ? 0 : counted->what.count) + gap.count, alarm.is_for_lianad};
  } else {
    say(alarm, "");
  }
  was_disk_full_ = was_disk_full_ || is_of_disk;
  ledger_.add(gap);
}

void Recorder::say(const Alarm& alarm, const std::string& more) {
  std::fprintf(stderr, "liana-archive: alarm: %s%s\n", alarm.text.c_str(), more.c_str());
  if (alarm.is_for_lianad) on_alarm_(alarm.text + more, alarm.count);
}

// What stands is said once, and then its number.
void Recorder::say_due(bool all) {
  for (const auto& entry : standing_.due(last_tick_, all ? std::optional<std::string_view>("") : std::nullopt))
    say(entry.what, " (" + std::to_string(entry.times) + " times since it was said)");
}

// A full disk: the ring makes room, then telemetry. Where that is not enough all waits, and is tried again with what
// comes next.
void Recorder::commit() {
  must_commit_ = false;
  last_commit_ = last_tick_;
  say_due(false);
  bool done = ledger_.commit();
  while (!done && (drop_oldest_ring_file(folder_) || telemetry_.make_room())) done = ledger_.commit();
  if (!done && !is_alarmed_) {
    std::fputs("liana-archive: alarm: the disk is full: events and commands wait\n", stderr);
    on_alarm_("the disk is full: events and commands wait", 0);
  }
  is_alarmed_ = !done;
  was_disk_full_ = was_disk_full_ || !done;
}

// To leave plain files takes room, too.
void Recorder::finish() {
  const auto with_room = [this](const auto& act) {
    for (;;) {
      try {
        return act();
      } catch (const DatabaseError& error) {
        if (!error.is_full || !drop_oldest_ring_file(folder_, false)) throw;
      }
    }
  };
  with_room([this] { telemetry_.finish(); });
  say_due(true);
  commit();
  with_room([this] { ledger_.finish(); });
}

}  // namespace liana::archive
