// How much of a way that is refused as a whole is free.
#pragma once

#include <string>
#include <utility>

namespace liana::clearance {

struct FreePart {
  double share = 1.0;   // of the way, to 0.01
  std::string refusal;  // of what comes after it; empty: all of it is free
};

// `refusal(share)` says why the arm must not go so much of the way; empty: it may. Asked once where all is free, else
// eight times.
template <class Refusal>
FreePart free_part(const Refusal& refusal) {
  FreePart out{1.0, refusal(1.0)};
  if (out.refusal.empty()) return out;
  double free = 0.0, beyond = 1.0;
  while (beyond - free > 0.01) {
    const double middle = 0.5 * (free + beyond);
    std::string found = refusal(middle);
    found.empty() ? free = middle : beyond = middle;
    if (!found.empty()) out.refusal = std::move(found);
  }
  out.share = free;
  return out;
}

}  // namespace liana::clearance
