#include "host/drives/calibration/tracker_track.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "host/base/file/in_file.hpp"
#include "host/drives/calibration/text.hpp"
#include "host/model/config/field.hpp"

namespace liana::calibration {
namespace {

using Index = std::size_t;

constexpr std::array<const char*, 8> kColumns{"time_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
constexpr Index kMaxColumns = 200, kMaxLine = 4000;
constexpr std::uintmax_t kMaxBytes = 400000000;
constexpr config::Range kTime{-1e12, 1e12}, kPlace{-100, 100}, kPart{-1.01, 1.01};  // s, m, of a quaternion
constexpr double kUnit = 0.01;                                                      // off a length of 1

constexpr double kCoarse_s = 0.5, kFine_s = 0.05;  // of the two searches for the offset
constexpr double kLongestGap_s = 0.5;              // between two rows; over it nobody knows where the marker was
constexpr double kAlike = 0.6;     // least correlation of the speeds: a marker beside the tip moves as that turns, too
constexpr double kStill_m = 3e-3;  // most that a marker at rest is off its mean

class Table {
 public:
  explicit Table(const std::string& path) : path_(path) {
    file::require_ordinary(path);
    in_.open(path);
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(path, none);
    if (!in_ || none) throw std::runtime_error(path + ": cannot be read: give a CSV file of tracker poses");
    if (bytes > kMaxBytes)
      throw std::runtime_error(path + text(": %.0f MB: allowed %.0f MB: cut the file to the time of the run",
                                           static_cast<double>(bytes) / 1e6, static_cast<double>(kMaxBytes) / 1e6));
    Index count = 0;
    next();
    for (const std::string_view name : cells()) {
      const auto known = std::ranges::find(kColumns, name);
      if (known != kColumns.end()) {
        Index& place = place_[static_cast<Index>(known - kColumns.begin())];
        if (place != kMaxColumns) refuse(*known, "twice", "each column once", "leave one of them out");
        place = count;
      }
      ++count;
    }
    for (Index i = 0; i < kColumns.size(); ++i) {
      if (place_[i] == kMaxColumns)
        refuse(kColumns[i], "no such column", "a first line with time_s,x_m,y_m,z_m,qw,qx,qy,qz",
               "name the columns so, in any order");
    }
  }

  // The next row that is not empty; false at the end.
  bool next() {
    while (std::getline(in_, line_)) {
      ++number_;
      if (line_.size() > kMaxLine)
        refuse("the line", text("%zu characters", line_.size()), text("%zu", kMaxLine),
               "look whether it is a CSV file");
      if (line_.ends_with('\r')) line_.pop_back();
      if (!line_.empty()) return true;
    }
    return false;
  }

  TrackedPose pose() const {
    const std::vector<std::string_view> values = cells();
    std::array<double, kColumns.size()> out{};
    for (Index i = 0; i < out.size(); ++i) {
      const std::string_view cell = place_[i] < values.size() ? values[place_[i]] : "";
      const auto read = std::from_chars(cell.begin(), cell.end(), out[i]);
      const config::Range& range = i == 0 ? kTime : i < 4 ? kPlace : kPart;
      if (read.ec != std::errc{} || read.ptr != cell.end() || !range.contains(out[i]))
        refuse(kColumns[i], std::string(cell.substr(0, 40)), "a number " + range.text(),
               "write seconds and metres, and leave out rows in which the tracker did not see the marker");
    }
    const Quat q{out[4], out[5], out[6], out[7]};
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (std::fabs(length - 1.0) > kUnit)
      refuse("qw, qx, qy, qz", text("length %.4g", length), "1 within 0.01", "export unit quaternions, w first");
    return {out[0], {{out[1], out[2], out[3]}, normalize(q)}};
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& value, const std::string& allowed,
                           const std::string& what_to_do) const {
    throw std::runtime_error(path_ + ": line " + std::to_string(number_) + ": " + what + ": '" + value +
                             "': allowed: " + allowed + ": " + what_to_do);
  }

 private:
  std::vector<std::string_view> cells() const {
    std::vector<std::string_view> out;
    for (std::string_view rest = line_; out.size() < kMaxColumns;) {
      const Index end = rest.find(',');
      std::string_view cell = rest.substr(0, end);
      while (cell.starts_with(' ')) cell.remove_prefix(1);
      while (cell.ends_with(' ')) cell.remove_suffix(1);
      out.push_back(cell);
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
    }
    return out;
  }

  std::string path_;
  std::ifstream in_;
  std::string line_;
  std::size_t number_ = 0;
  std::array<Index, kColumns.size()> place_ = [] {
    std::array<Index, kColumns.size()> none{};
    none.fill(kMaxColumns);
    return none;
  }();
};

// Where it is in steps of `step_s` from its first point on; nothing in gaps.
std::vector<std::optional<Vec3>> places_m(const std::vector<TimedPoint>& way, double step_s) {
  std::vector<std::optional<Vec3>> out;
  Index at = 0;
  for (double time_s = way.front().time_s; time_s <= way.back().time_s; time_s += step_s) {
    while (at + 2 < way.size() && way[at + 1].time_s <= time_s) ++at;
    const TimedPoint &a = way[at], &b = way[at + 1];
    const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
    out.push_back(b.time_s - a.time_s > kLongestGap_s
                      ? std::nullopt
                      : std::optional(add(a.position_m, scale(subtract(b.position_m, a.position_m), share))));
  }
  return out;
}

// How far it goes in kCoarse_s, in steps of `step_s`; 0 where nothing is known.
std::vector<double> travels_m(const std::vector<TimedPoint>& way, double step_s) {
  const std::vector<std::optional<Vec3>> place_m = places_m(way, step_s);
  const auto later = static_cast<Index>(std::lround(kCoarse_s / step_s));
  std::vector<double> out;
  for (Index i = 0; i + later < place_m.size(); ++i)
    out.push_back(place_m[i] && place_m[i + later] ? norm(subtract(*place_m[i + later], *place_m[i])) : 0.0);
  return out;
}

// How alike two speeds are, the second one `shift` steps later, where both are known.
struct Likeness {
  double count = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;  // sums

  double correlation() const {
    const double squares = (count * aa - a * a) * (count * bb - b * b);
    return squares > 0.0 ? (count * ab - a * b) / std::sqrt(squares) : 0.0;
  }
};

Likeness likeness(const std::vector<double>& a, const std::vector<double>& b, long shift) {
  Likeness out;
  const long first = std::max(0L, shift),
             last = std::min(static_cast<long>(a.size()), static_cast<long>(b.size()) + shift);
  for (long i = first; i < last; ++i) {
    const double x = a[static_cast<Index>(i)], y = b[static_cast<Index>(i - shift)];
    out.count += 1.0;
    out.a += x;
    out.b += y;
    out.aa += x * x;
    out.bb += y * y;
    out.ab += x * y;
  }
  return out;
}

long best_shift(const std::vector<double>& a, const std::vector<double>& b, long first, long last) {
  long best = first;
  double most = -1.0;
  for (long shift = first; shift <= last; ++shift) {
    const double both = likeness(a, b, shift).ab;
    if (both > most) most = both, best = shift;
  }
  return best;
}

}  // namespace

std::vector<TrackedPose> read_tracker(const std::string& path) {
  Table table(path);
  std::vector<TrackedPose> out;
  while (table.next()) {
    const TrackedPose row = table.pose();
    if (!out.empty() && !(row.time_s > out.back().time_s))
      table.refuse("time_s", text("%.10g", row.time_s), text("over %.10g, that of the row before", out.back().time_s),
                   "sort the rows by their time");
    if (out.size() == kMaxTrackerRows || (!out.empty() && row.time_s - out.front().time_s > kMaxTrack_s))
      table.refuse("time_s", text("%.10g, row %zu", row.time_s, out.size() + 1),
                   text("%zu rows and %.0f s", kMaxTrackerRows, kMaxTrack_s), "cut the file to the time of the run");
    out.push_back(row);
  }
  if (out.size() < 2) table.refuse("rows", std::to_string(out.size()), "2 or more", "give all poses of the run");
  return out;
}

double clock_offset_s(const std::vector<TimedPoint>& tip, const std::vector<TrackedPose>& tracked) {
  std::vector<TimedPoint> marker;
  for (const TrackedPose& row : tracked) marker.push_back({row.time_s, row.marker_in_tracker.position_m});
  const double begins_s = tip.front().time_s - marker.front().time_s;
  double later_s = 0.0, span_s = std::max(tip.back().time_s - tip.front().time_s, kMaxTrack_s);
  Likeness best;
  for (const double step_s : {kCoarse_s, kFine_s}) {
    const std::vector<double> a = travels_m(tip, step_s), b = travels_m(marker, step_s);
    const long middle = std::lround(later_s / step_s), room = std::lround(span_s / step_s);
    const long shift = best_shift(a, b, middle - room, middle + room);
    best = likeness(a, b, shift);
    later_s = static_cast<double>(shift) * step_s;
    span_s = 2.0 * kCoarse_s;
  }
  if (!(best.correlation() >= kAlike))
    throw std::runtime_error(
        text("the marker never moves as the tip of the run does (correlation %.2f at best): allowed %.1f: give the "
             "poses that were tracked during this run",
             best.correlation(), kAlike));
  return begins_s + later_s;
}

std::optional<Pose> mean_pose(const std::vector<TrackedPose>& tracked, double from_s, double to_s) {
  const auto first = std::ranges::lower_bound(tracked, from_s, {}, &TrackedPose::time_s),
             last = std::ranges::upper_bound(tracked, to_s, {}, &TrackedPose::time_s);
  const auto count = last - first;
  if (count < static_cast<std::ptrdiff_t>(kMinSamples)) return std::nullopt;
  Pose mean{{}, {}};
  for (auto row = first; row != last; ++row) {
    const Quat &q = row->marker_in_tracker.quaternion, &begin = first->marker_in_tracker.quaternion;
    const double sign = q[0] * begin[0] + q[1] * begin[1] + q[2] * begin[2] + q[3] * begin[3] < 0.0 ? -1.0 : 1.0;
    mean.position_m = add(mean.position_m, scale(row->marker_in_tracker.position_m, 1.0 / static_cast<double>(count)));
    for (Index i = 0; i < 4; ++i) mean.quaternion[i] += sign * q[i];
  }
  mean.quaternion = normalize(mean.quaternion);
  for (auto row = first; row != last; ++row) {
    if (norm(subtract(row->marker_in_tracker.position_m, mean.position_m)) > kStill_m) return std::nullopt;
  }
  return mean;
}

}  // namespace liana::calibration
