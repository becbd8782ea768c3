#include "host/archive/ledger.hpp"

#include <utility>

#include "host/archive/schema.hpp"
#include "host/event/event_json.hpp"
#include "host/json/json.hpp"

namespace liana::archive {

Ledger::Ledger(const std::string& folder) : database_(folder + "/" + kArchiveFile, Database::Open::kDurable) {
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
  if (waiting_.size() >= kMostWaiting) {
    ++lost_;
  } else {
    waiting_.push_back(std::move(insert));
  }
}

void Ledger::add(const event::Event& event) {
  wait([this, event, life = life_] {
    event_->run(life, event.sequence, event.tick, event::event_kind_name(event.kind), event.number, event.subject,
                event::event_json(event).at("values").dump(), event.text);
  });
}

void Ledger::add(const Command& c) {
  wait([this, c, life = life_] {
    if (c.released) {
      command_->run(life, c.sequence, c.tick, 1, c.code, c.share, nullptr, nullptr, nullptr, nullptr);
    } else {
      command_->run(life, c.sequence, c.tick, 0, c.code, c.share, c.name, c.text, c.remedy, c.margin);
    }
  });
}

void Ledger::add(const Gap& gap) {
  wait([this, gap, life = life_] { gap_->run(life, gap.first_tick, gap.last_tick, gap.what, gap.count, gap.text); });
}

void Ledger::add_telemetry_file(std::uint64_t first_tick) {
  if (waiting_.size() < kMostWaiting) ++files_waiting_;
  wait([this, first_tick, life = life_] { telemetry_file_->run(life, first_tick); });
}

bool Ledger::commit() {
  if (waiting_.empty()) return true;
  try {
    Transaction all(database_);
    for (const auto& insert : waiting_) insert();
    all.commit();
  } catch (const DatabaseError& error) {
    if (!error.is_full) throw;
    return false;
  }
  durable_ += waiting_.size() - std::exchange(files_waiting_, 0);
  waiting_.clear();
  return true;
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
