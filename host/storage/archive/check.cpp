#include "host/storage/archive/check.hpp"

#include <stdexcept>

#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/stretches.hpp"

namespace liana::archive {
namespace {

// Numbers of events rise one by one; of those that lianad no longer had a gap tells.
void check_events(const Reader& reader, LifeCheck& life, std::vector<std::string>& problems) {
  std::uint64_t expected = 0, missing = 0, told = 0;
  for (const event::Event& event : reader.events()) {
    if (expected != 0) missing += event.sequence - expected;
    expected = event.sequence + 1;
    ++life.events;
  }
  for (const Gap& gap : life.gaps) told += gap.what == "events" ? gap.count : 0;
  if (missing > told) problems.push_back(std::to_string(missing - told) + " events are missing and no gap tells of it");
}

void check_telemetry(const Reader& reader, LifeCheck& life) {
  const auto recorded = reader.recorded();
  if (!recorded) return;
  life.from_s = static_cast<double>(recorded->first) * reader.life().period_s;
  life.to_s = static_cast<double>(recorded->last) * reader.life().period_s;
  life.records = Stretches(reader, kAll).visit([](const std::string&, const Json&) {});
}

LifeCheck check_life(const Reader& reader, std::vector<std::string>& problems) {
  LifeCheck life;
  life.number = reader.life_number();
  life.finished = reader.is_finished();
  life.period_s = reader.life().period_s;
  life.gaps = reader.gaps();
  const Counts counts = reader.counts();
  life.commands = counts.commands;
  life.refused = counts.refused;
  check_events(reader, life, problems);
  for (const std::string& file : reader.missing_files())
    problems.push_back(reader.folder() + "/" + file + ": is missing; copy it from where the run was recorded");
  check_telemetry(reader, life);
  life.ring = check_ring(reader.folder(), life.number, problems);
  return life;
}

}  // namespace

Check check(const std::string& folder) {
  Check result;
  const Reader newest(folder);
  result.bytes = newest.bytes();
  result.problems = newest.problems();
  if (!result.problems.empty()) return result;
  for (std::uint64_t life = 1; life <= newest.lives(); ++life) {
    try {
      result.lives.push_back(check_life(Reader(folder, life), result.problems));
      result.bytes += result.lives.back().ring.bytes;
    } catch (const std::runtime_error& error) {
      result.problems.push_back(error.what());
    }
  }
  return result;
}

}  // namespace liana::archive
