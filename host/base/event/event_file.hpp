// The file of events: a LineFile whose parts all begin with the cause of what goes on.
#pragma once

#include <optional>
#include <string>

#include "host/base/event/line_file.hpp"

namespace liana::event {

class EventFile {
 public:
  // As of LineFile; `period_s`: of the ticks.
  EventFile(const std::string& path, double period_s, std::uint64_t part_bytes = LineFile::kPartBytes)
      : period_s_(period_s), file_(path, "--events", kEventLineHeading, part_bytes) {}

  // The first fault or boot problem after a clear is the cause of what follows.
  void append(const Event& event) {
    const std::string line = event_line(event, period_s_);
    const bool is_wrong = event.kind == EventKind::kFault || event.kind == EventKind::kBootProblem;
    if (is_wrong && !has_cause_) file_.repeat(line);
    const bool is_cleared = event.kind == EventKind::kClear && event.number == 0;
    has_cause_ = (has_cause_ || is_wrong) && !is_cleared;
    file_.append(line);
  }
  // As of LineFile.
  std::optional<Event> change() { return file_.change(); }

 private:
  double period_s_;
  LineFile file_;
  bool has_cause_ = false;
};

}  // namespace liana::event
