// Reads the control-rate ring of a run, also while it is written. Any minute comes within a fraction of a second.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/storage/archive/ring_files.hpp"
#include "host/storage/archive/ring_segment.hpp"
#include "host/storage/archive/rows.hpp"
#include "host/storage/archive/tick_block.hpp"

namespace liana::archive {

// What a visit calls; unset members are skipped.
struct RingVisitor {
  // Images come before the ticks of the file that they are in. `about`: of that file.
  std::function<void(const RingAbout& about, std::uint64_t next_tick, const std::string& packet)> image;
  std::function<void(const RingAbout& about, const RingTick& tick)> tick;
};

class RingReader {
 public:
  // `life`: of the archive in this folder.
  RingReader(const std::string& folder, std::uint64_t life);

  // From the first tick to the last; nothing where there is no ring.
  std::optional<Span> recorded() const;
  // Of all files.
  std::uint64_t bytes() const;

  // The ticks of the span in order, and the images of the files that hold them. Throws std::runtime_error with the file
  // that is damaged.
  void visit(Span span, const RingVisitor& visitor) const;

 private:
  std::vector<RingFile> of(RingKind kind) const;

  std::vector<RingFile> files_;
};

// What a ring holds.
struct RingCheck {
  std::uint64_t ticks = 0, full_ticks = 0;  // full: with Outputs
  std::uint64_t missing = 0;                // between the first and the last
  std::uint64_t images = 0, files = 0, cut_short = 0, bytes = 0;
  std::uint64_t first_tick = 0, last_tick = 0;
};
// Reads every file and holds all that is there against its checksums. `problems` gets what is wrong, with its file; a
// file that is still written, or whose writer was killed, is cut short, and no problem.
RingCheck check_ring(const std::string& folder, std::uint64_t life, std::vector<std::string>& problems);

}  // namespace liana::archive
