#include "host/storage/archive/ring_files.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <tuple>

namespace liana::archive {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kNames{"outputs", "kept", "inputs"};  // in the order of RingKind

// False: it is still there.
bool remove(const RingFile& file) {
  std::error_code failed;
  fs::remove(file.path, failed);
  return !failed;
}

// The newest of a kind may be being written.
bool is_newest(const std::vector<RingFile>& files, const RingFile& file) {
  return std::none_of(files.begin(), files.end(), [&](const RingFile& other) {
    return other.kind == file.kind && std::tie(other.life, other.first_tick) > std::tie(file.life, file.first_tick);
  });
}

// The oldest one that may go; kept Outputs are never being written.
std::vector<RingFile>::iterator oldest(std::vector<RingFile>& files) {
  return std::find_if(files.begin(), files.end(),
                      [&](const RingFile& file) { return file.kind == RingKind::kKept || !is_newest(files, file); });
}

}  // namespace

std::string ring_path(const std::string& folder, RingKind kind, std::uint64_t life, std::uint64_t first_tick) {
  char name[80];
  std::snprintf(name, sizeof name, "/ring-%s-%" PRIu64 "-%012" PRIu64 ".mcap", kNames[static_cast<std::size_t>(kind)],
                life, first_tick);
  return folder + name;
}

std::vector<RingFile> ring_files(const std::string& folder) {
  std::vector<RingFile> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename();
    for (const RingKind kind : {RingKind::kOutputs, RingKind::kKept, RingKind::kInputs}) {
      RingFile file{kind, 0, 0, entry.path()};
      const std::string form =
          std::string("ring-") + kNames[static_cast<std::size_t>(kind)] + "-%" SCNu64 "-%" SCNu64 ".mcap";
      const bool is_one = std::sscanf(name.c_str(), form.c_str(), &file.life, &file.first_tick) == 2 &&
                          ring_path(folder, kind, file.life, file.first_tick).ends_with("/" + name);
      if (is_one) found.push_back(file);
    }
  }
  std::sort(found.begin(), found.end(), [](const RingFile& a, const RingFile& b) {
    return std::tie(a.life, a.first_tick, a.kind) < std::tie(b.life, b.first_tick, b.kind);
  });
  return found;
}

std::uint64_t bytes_of(const RingFile& file) {
  std::error_code none;
  const std::uintmax_t bytes = fs::file_size(file.path, none);
  return none ? 0 : bytes;
}

bool drop_oldest_ring_file(const std::string& folder, bool is_open) {
  std::vector<RingFile> files = ring_files(folder);
  const auto goes = is_open ? oldest(files) : files.begin();
  return goes != files.end() && remove(*goes);
}

void keep_to_limits(const std::string& folder, const RingLimits& limits, double period_s, std::uint64_t life,
                    std::uint64_t tick) {
  std::vector<RingFile> files = ring_files(folder);
  const auto is_over = [&](const RingFile& file) {
    const double age_s = static_cast<double>(tick - (file.life == life ? file.first_tick : 0)) * period_s;
    const bool is_thinned = file.kind == RingKind::kOutputs && age_s > limits.full_s + limits.outputs_file_s;
    return !is_newest(files, file) && (is_thinned || age_s > limits.most_s + limits.inputs_file_s);
  };
  std::vector<RingFile> stay;
  for (const RingFile& file : files) {
    if (!is_over(file) || !remove(file)) stay.push_back(file);
  }
  std::uint64_t bytes = 0;
  for (const RingFile& file : stay) bytes += bytes_of(file);
  for (auto goes = oldest(stay); bytes > limits.bytes && goes != stay.end(); goes = oldest(stay)) {
    const std::uint64_t freed = bytes_of(*goes);
    if (remove(*goes)) bytes -= freed;
    stay.erase(goes);
  }
}

void keep_outputs(const std::string& folder, std::uint64_t life, Span ticks, std::uint64_t file_ticks, bool is_open) {
  const std::vector<RingFile> files = ring_files(folder);
  for (const RingFile& file : files) {
    const bool is_meant = file.kind == RingKind::kOutputs && file.life == life && file.first_tick <= ticks.last &&
                          file.first_tick + file_ticks > ticks.first;
    if (!is_meant || (is_open && is_newest(files, file))) continue;
    std::error_code gone;  // a full disk may have taken it
    fs::rename(file.path, ring_path(folder, RingKind::kKept, life, file.first_tick), gone);
  }
}

}  // namespace liana::archive
