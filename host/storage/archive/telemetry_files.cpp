#include "host/storage/archive/telemetry_files.hpp"

#include <algorithm>
#include <utility>

#include "host/base/json/json.hpp"
#include "host/storage/archive/chunk.hpp"
#include "host/storage/archive/facts_change.hpp"
#include "host/storage/archive/ring_files.hpp"
#include "host/storage/archive/schema.hpp"
#include "host/storage/archive/segments.hpp"

namespace liana::archive {
namespace {

constexpr double kChunk_s = 1.0;
constexpr double kWhole_s = 60.0;  // of facts: so much is read at most to know them

Database made(const std::string& path) {
  Database database(path, Database::Open::kQuick);
  database.run(kTelemetrySchema);
  return database;
}

}  // namespace

TelemetryFiles::File::File(const std::string& path, const std::optional<telemetry::Layout>& layout)
    : database(made(path)),
      telemetry(database, "INSERT OR REPLACE INTO telemetry VALUES(?,?,?,?)"),
      facts(database, "INSERT OR REPLACE INTO facts VALUES(?,?,?,?)") {
  if (layout) figures.emplace(database, *layout);
}

TelemetryFiles::TelemetryFiles(std::string folder, std::uint64_t life, double period_s, TelemetryLimits limits,
                               std::function<void(const Gap&)> on_gap, std::function<void(std::uint64_t)> on_file)
    : folder_(std::move(folder)),
      life_(life),
      period_s_(period_s),
      limits_(limits),
      on_gap_(std::move(on_gap)),
      on_file_(std::move(on_file)) {}

void TelemetryFiles::set_facts(const Facts& facts) { waiting_.push_back(facts); }

void TelemetryFiles::add(std::uint64_t tick, const std::string& record) {
  const auto chunk_ticks = kChunk_s / period_s_;
  if (count_ > 0 && static_cast<double>(tick - first_tick_) >= chunk_ticks) {
    std::vector<Facts> of_this;  // what was set for this record belongs to the next second
    while (!waiting_.empty() && waiting_.back().tick >= tick) {
      of_this.insert(of_this.begin(), std::move(waiting_.back()));
      waiting_.pop_back();
    }
    flush();
    waiting_ = std::move(of_this);
  }
  if (count_++ == 0) first_tick_ = tick;
  last_tick_ = tick;
  records_ += record;
}

void TelemetryFiles::open_file(std::uint64_t first_tick) {
  if (file_) file_->database.finish();
  const Segment next{life_, first_tick, segment_path(folder_, life_, first_tick)};
  try {
    file_ = std::make_unique<File>(next.path, layout_);
  } catch (const DatabaseError&) {
    remove_segment(next);
    throw;
  }
  file_->first_tick = first_tick;
  keep_to_limit();
}

void TelemetryFiles::write() {
  const bool is_over = file_ && static_cast<double>(first_tick_ - file_->first_tick) * period_s_ >= limits_.file_s;
  if (!file_ || is_over) open_file(first_tick_);
  Transaction second(file_->database);
  const bool begins_with_facts = !waiting_.empty() && waiting_.front().tick <= first_tick_;
  if (!file_->told && current_ && !begins_with_facts) write_facts(*current_, first_tick_);
  for (const Facts& facts : waiting_) write_facts(facts, facts.tick);
  const std::string blob = packed(records_, records_.size() / count_);
  file_->telemetry.run(first_tick_, last_tick_, count_, Blob{blob});
  if (file_->figures) file_->figures->write(records_);
  second.commit();
  if (!std::exchange(file_->is_told, true)) on_file_(file_->first_tick);
}

// Whole where a file begins and from time to time, else what has changed.
void TelemetryFiles::write_facts(const Facts& facts, std::uint64_t tick) {
  const bool is_old = static_cast<double>(tick - file_->whole_tick) * period_s_ >= kWhole_s;
  std::optional<Json> change;
  if (file_->told && !is_old) change = change_of(file_->told->state, facts.state);
  if (!change) file_->whole_tick = tick;
  const Json& written = change ? *change : facts.state;
  file_->facts.run(tick, facts.number, change ? 0 : 1, written.dump(-1, Json::BadUtf8::kReplace));
  file_->told = facts;
}

void TelemetryFiles::flush() {
  if (count_ == 0) return;
  for (bool written = false; !written;) {
    try {
      write();
      written = true;
      end_of_loss();
    } catch (const DatabaseError& error) {
      if (!error.is_full) throw;
      if (file_) file_->told.reset();  // it was not written
      if (drop_oldest_ring_file(folder_) || drop_oldest(kDiskFull, false)) continue;
      lose_second();
      break;
    }
  }
  if (!waiting_.empty()) current_ = std::move(waiting_.back());
  waiting_.clear();
  records_.clear();
  count_ = 0;
}

// Said as it begins, and once more with all the rest when it is over.
void TelemetryFiles::lose_second() {
  const Gap second{first_tick_, last_tick_, "telemetry", count_, kDiskFull};
  if (!losing_) {
    on_gap_(second);
    losing_ = Gap{last_tick_ + 1, last_tick_, second.what, 0, second.text};
    return;
  }
  losing_->last_tick = last_tick_;
  losing_->count += count_;
}

void TelemetryFiles::end_of_loss() {
  if (losing_ && losing_->count > 0) on_gap_(*losing_);
  losing_.reset();
}

bool TelemetryFiles::make_room() { return drop_oldest(kRoomForRows, true); }

// Of the file that is written only when `also_newest`; false: there is none that can be dropped.
bool TelemetryFiles::drop_oldest(const std::string& why, bool also_newest) {
  const std::vector<Segment> files = segments_in(folder_);
  if (files.empty() || (files.size() == 1 && file_ && !also_newest)) return false;
  const bool has_next = files.size() > 1 && files[1].life == files[0].life;
  const std::uint64_t last = has_next ? files[1].first_tick - 1 : std::max(files[0].first_tick, last_tick_);
  if (files.size() == 1) file_.reset();
  if (!remove_segment(files[0])) return false;
  on_gap_({files[0].first_tick, last, "telemetry", 0, why});
  return true;
}

void TelemetryFiles::keep_to_limit() {
  while (bytes_of(segments_in(folder_)) > limits_.bytes) {
    if (!drop_oldest(kTooOld, false)) return;
  }
}

void TelemetryFiles::finish() {
  flush();
  end_of_loss();
  if (file_) file_->database.finish();
  file_.reset();
}

}  // namespace liana::archive
