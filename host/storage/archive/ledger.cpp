#include "host/storage/archive/ledger.hpp"

#include <algorithm>
#include <utility>

#include "host/base/event/event_json.hpp"
#include "host/base/json/json.hpp"
#include "host/storage/archive/schema.hpp"

namespace liana::archive {

Ledger::Ledger(const std::string& folder, const LedgerLimits& limits)
    : limits_(limits), database_(folder + "/" + kArchiveFile, Database::Open::kDurable) {
  if (const std::string problem = database_.problem(true); !problem.empty())
    throw DatabaseError(problem + "; move the file away, a new one is made", false);
  database_.run(kArchiveSchema);
  event_.emplace(database_, "INSERT OR IGNORE INTO event VALUES(?,?,?,?,?,?,?,?)");
  command_.emplace(database_, "INSERT OR REPLACE INTO command VALUES(?,?,?,?,?,?,?,?,?,?)");
  gap_.emplace(database_, "INSERT INTO gap VALUES(?,?,?,?,?,?)");
  telemetry_file_.emplace(database_, "INSERT OR IGNORE INTO telemetry_file VALUES(?,?)");
}

Ledger::Begun Ledger::begin(const Life& life, std::uint64_t next_event) {
  Statement cut_off(database_,
                    "SELECT id FROM life WHERE id=(SELECT max(id) FROM life) AND finished=0 AND config_hash=? AND "
                    "made_by=? AND (SELECT ifnull(max(sequence), 0) FROM event WHERE event.life=life.id) < ?");
  cut_off.bind(life.config_hash, life.made_by, next_event);
  while (cut_off.step()) life_ = cut_off.count(0);
  if (life_ != 0) return {life_, true};
  Statement insert(database_,
                   "INSERT INTO life(started_utc, made_by, config_hash, time_mode, period_s, robot, scene, buses) "
                   "VALUES(?,?,?,?,?,?,?,?) RETURNING id");
  insert.bind(life.started_utc, life.made_by, life.config_hash, life.time_mode, life.period_s, life.robot, life.scene,
              life.buses);
  while (insert.step()) life_ = insert.count(0);
  return {life_, false};
}

void Ledger::set_layout(const Json& layout) {
  Statement(database_, "UPDATE life SET layout=? WHERE id=?").run(layout.dump(), life_);
}

void Ledger::wait(std::function<void()> insert) {
  if (waiting_.size() >= kMaxQueuedWrites) {
    ++lost_;
  } else {
    waiting_.push_back(std::move(insert));
  }
}

void Ledger::add(const event::Event& event) {
  newest_event_ = event.sequence;
  newest_tick_ = event.tick;
  wait([this, event, life = life_] {
    event_->run(life, event.sequence, event.tick, event::event_kind_name(event.kind), event.number, event.subject,
                event::event_json(event).at("values").dump(), event.text);
  });
}

void Ledger::add(const Command& c) {
  newest_command_ = c.sequence;
  wait([this, c, life = life_] {
    if (c.released) {
      command_->run(life, c.sequence, c.tick, 1, c.code, c.share, nullptr, nullptr, nullptr, nullptr);
    } else {
      command_->run(life, c.sequence, c.tick, 0, c.code, c.share, c.name, c.text, c.remedy, c.margin);
    }
  });
}

void Ledger::add(const Gap& gap) {
  ++gaps_;
  wait([this, gap, life = life_] { gap_->run(life, gap.first_tick, gap.last_tick, gap.what, gap.count, gap.text); });
}

void Ledger::add_telemetry_file(std::uint64_t first_tick) {
  if (waiting_.size() < kMaxQueuedWrites) ++files_waiting_;
  wait([this, first_tick, life = life_] { telemetry_file_->run(life, first_tick); });
}

bool Ledger::commit() {
  if (waiting_.empty()) return true;
  try {
    Transaction all(database_);
    for (const auto& insert : waiting_) insert();
    drop_oldest();
    all.commit();
  } catch (const DatabaseError& error) {
    if (!error.is_full) throw;
    return false;
  }
  durable_ += waiting_.size() - std::exchange(files_waiting_, 0);
  waiting_.clear();
  return true;
}

void Ledger::drop_events(std::uint64_t from, std::uint64_t to) {
  constexpr const char* kRoom = "made room for newer ones";
  Statement(database_, "DELETE FROM event WHERE life=? AND sequence BETWEEN ? AND ?").run(life_, from, to);
  Statement told(database_, "UPDATE gap SET last_tick=?, count=count+changes() WHERE life=? AND text=? RETURNING 1");
  told.bind(newest_tick_, life_, kRoom);
  bool is_told = false;
  while (told.step()) is_told = true;
  if (!is_told) gap_->run(life_, newest_tick_, newest_tick_, "events", to - from + 1, kRoom);
}

// In the transaction that adds what takes their place. Where it fails they are dropped with the next.
void Ledger::drop_oldest() {
  const auto oldest = [this](std::uint64_t newest, std::uint64_t kept, std::uint64_t dropped) {
    return newest > kept + dropped + limits_.at_once ? newest - kept : 0;
  };
  const std::uint64_t first = limits_.first_events;
  if (const std::uint64_t to = oldest(newest_event_, limits_.newest_events, std::max(first, events_dropped_));
      to != 0) {
    drop_events(first + 1, to);
    events_dropped_ = to;
  }
  if (const std::uint64_t to = oldest(newest_command_, limits_.commands, commands_dropped_); to != 0) {
    Statement(database_, "DELETE FROM command WHERE life=? AND sequence<=?").run(life_, to);
    commands_dropped_ = to;
  }
  if (const std::uint64_t to = oldest(gaps_, limits_.gaps, gaps_dropped_); to != 0) {
    Statement(
        database_,
        "DELETE FROM gap WHERE life=? AND what IN ('states', 'ticks') AND rowid <= (SELECT max(rowid) FROM gap) - ?")
        .run(life_, limits_.gaps);
    gaps_dropped_ = to;
  }
}

void Ledger::finish() {
  Statement(database_, "UPDATE life SET finished=1 WHERE id=?").run(life_);
  event_.reset();
  command_.reset();
  gap_.reset();
  telemetry_file_.reset();
  database_.finish();
}

}  // namespace liana::archive
