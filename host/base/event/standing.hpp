// What stands is told once: its first cases at once, then their number at a slow rate, and once more when it is over.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace liana::event {

// Times are in a unit of the owner's (ticks, ms), of any clock that never goes back. `What`: what the owner keeps of
// the cases that were not told.
template <class What>
class Standing {
 public:
  // Whoever makes up ever new keys fills no memory: from here on new ones are counted under a key that they share.
  static constexpr std::size_t kMaxKeys = 128;

  struct Rule {
    std::uint64_t over_after = 0;   // without another case it is over
    std::uint64_t again_after = 0;  // while it stands its number is told so often at most
  };
  struct Entry {
    std::string key;
    std::uint64_t times = 0;  // that were not told
    std::uint64_t last = 0;   // when it came last
    bool is_over = false;
    What what{};

    std::uint64_t told = 0;  // when it was told last
    std::uint32_t shown = 0;
  };

  explicit Standing(const Rule& rule) : rule_(rule) {}

  // One more case. nullptr: it is to be told as it is, as the first `burst` are. Otherwise it is counted, and what is
  // kept of it is there to be brought up to date, until the next call.
  Entry* take(const std::string& key, const std::string& shared_key, std::uint64_t now, std::uint32_t burst) {
    Entry& entry = entry_of(key, shared_key);
    entry.last = now;
    if (entry.shown < burst) {
      ++entry.shown;
      entry.told = now;
      return nullptr;
    }
    ++entry.times;
    return &entry;
  }

  // What is to be told now of cases that were only counted, the latest last: what is over, and what still stands and
  // was not told for long. Keys that begin with `ended` (all with an empty one) count as over.
  std::vector<Entry> due(std::uint64_t now, std::optional<std::string_view> ended = std::nullopt) {
    std::vector<Entry> out;
    for (Entry& entry : entries_) {
      entry.is_over = now - entry.last > rule_.over_after || (ended && entry.key.starts_with(*ended));
      const bool is_due = entry.is_over || now - entry.told >= rule_.again_after;
      if (!is_due || entry.times == 0) continue;
      out.push_back(entry);
      entry.told = now;
      entry.times = 0;
    }
    std::erase_if(entries_, [](const Entry& entry) { return entry.is_over; });
    std::stable_sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) { return a.last < b.last; });
    return out;
  }

 private:
  Entry& entry_of(const std::string& key, const std::string& shared_key) {
    const auto named = [this](const std::string& name) {
      return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == name; });
    };
    auto found = named(key);
    const bool shares = found == entries_.end() && entries_.size() >= kMaxKeys;
    if (shares) found = named(shared_key);
    if (found != entries_.end()) return *found;
    entries_.push_back({.key = shares ? shared_key : key});
    return entries_.back();
  }

  Rule rule_;
  std::vector<Entry> entries_;
};

}  // namespace liana::event
