#include "host/control/server/retract_path_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "host/control/arbiter/path_history.hpp"
#include "host/model/config/sha256.hpp"
#include "host/storage/recording/crc32.hpp"

namespace liana::server {
namespace {

constexpr std::string_view kMagic = "LIANAWAY";
constexpr std::uint32_t kFormat = 2;  // 1 had the robot's name alone
constexpr std::array<const char*, 3> kBasis{"robot table", "calibration", "scene"};
constexpr std::size_t kHeaderBytes = 64;
constexpr std::size_t kPointsPerSync = 50;  // a second of motion is what a computer without power may lose

struct Header {
  std::array<char, 8> magic{};
  std::uint16_t format = kFormat, joints = 0;
  std::uint32_t crc = 0;                    // of all but this
  std::uint64_t first = 0, end = 0;         // numbers of the oldest point and after the newest
  std::array<std::uint64_t, 3> basis{};     // as kBasis
  std::array<std::uint64_t, 1> reserved{};  // 0
};
static_assert(sizeof(Header) == kHeaderBytes);

std::uint32_t crc_of(const void* bytes, std::size_t count) {
  recording::Crc32 crc;
  crc.add({static_cast<const char*>(bytes), count});
  return crc.value();
}

std::uint32_t crc_of(Header header) {
  header.crc = 0;
  return crc_of(&header, sizeof header);
}

std::uint64_t hash_of(const std::string& text) {
  return std::stoull(config::sha256_hex(text).substr(0, 16), nullptr, 16);
}

// Why a path with this header is of no use here; empty: it is.
std::string why_unused(const Header& header, std::size_t joints, const std::array<std::uint64_t, 3>& basis) {
  if (header.format != kFormat) return "its format is not " + std::to_string(kFormat);
  if (header.crc != crc_of(header) || header.first > header.end ||
      header.end - header.first > arbiter::kMaxRetractPoints)
    return "its header is damaged";
  std::string other;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    if (header.basis[i] != basis[i]) other += (other.empty() ? "" : ", ") + std::string(kBasis[i]);
  }
  if (other.empty() && header.joints != joints) other = "number of joints";
  return other.empty() ? "" : "it was verified with another " + other;
}

// A whole header says that no point follows it.
bool is_empty(const Header& header) {
  return header.format == kFormat && header.crc == crc_of(header) && header.first == header.end;
}

// Where nothing is put aside yet; the last one is replaced when all are taken.
std::string name_aside(const std::string& path) {
  constexpr int kMost = 9;
  std::string name = path + ".unused";
  for (int i = 2; i <= kMost && ::access(name.c_str(), F_OK) == 0; ++i) name = path + ".unused-" + std::to_string(i);
  return name;
}

bool write_at(int fd, const void* bytes, std::size_t count, std::uint64_t offset) {
  const ssize_t done = ::pwrite(fd, bytes, count, static_cast<off_t>(offset));
  if (done >= 0 && static_cast<std::size_t>(done) != count) errno = ENOSPC;
  return done >= 0 && static_cast<std::size_t>(done) == count;
}

bool read_at(int fd, void* bytes, std::size_t count, std::uint64_t offset) {
  return ::pread(fd, bytes, count, static_cast<off_t>(offset)) == static_cast<ssize_t>(count);
}

}  // namespace

RetractPathFile::RetractPathFile(const std::string& path, const PathBasis& basis, std::size_t joints)
    : path_(path),
      joints_(joints),
      robot_(basis.name),
      basis_{hash_of(basis.robot), hash_of(basis.calibration), hash_of(basis.scene)} {
  open();
  try {
    read();
    thread_ = std::thread([this] { work(); });
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

RetractPathFile::~RetractPathFile() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
  ::close(fd_);
}

// A number, whether the arm was enabled there, the joints, a checksum of these.
std::size_t RetractPathFile::record_bytes() const { return 8 * (joints_ + 3); }

void RetractPathFile::open() {
  fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd_ < 0) {
    throw std::runtime_error("--retract-path: '" + path_ + "': cannot be written: " + std::strerror(errno) +
                             "; give a file in a folder that exists");
  }
  if (::flock(fd_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(fd_);
  throw std::runtime_error("--retract-path: '" + path_ +
                           "': another lianad keeps its way back there; give a file of its own");
}

// Its points may be the only way out for whoever starts again with what they were verified with.
void RetractPathFile::put_aside(const std::string& why) {
  const std::string aside = name_aside(path_);
  unused_ = "the retract path in " + path_ + " is not used: " + why + "; it is kept in " + aside +
            ": start with what it was made with and --retract-path " + aside + ", or move the arm out yourself";
  if (::rename(path_.c_str(), aside.c_str()) != 0)
    throw std::runtime_error("--retract-path: '" + path_ + "': cannot be renamed to " + aside + ": " +
                             std::strerror(errno));
  ::close(fd_);
  open();
}

// An empty file is a new one.
void RetractPathFile::read() {
  struct stat status {};
  const bool is_file = ::fstat(fd_, &status) == 0 && S_ISREG(status.st_mode);
  Header header;
  const bool has_header = is_file && read_at(fd_, &header, sizeof header, 0) &&
                          std::equal(kMagic.begin(), kMagic.end(), header.magic.begin());
  if (!is_file || (status.st_size > 0 && !has_header)) {
    throw std::runtime_error("--retract-path: '" + path_ + "': holds no way back of " + robot_ +
                             "; give another file, or one that does not exist yet");
  }
  if (const std::string why = has_header ? why_unused(header, joints_, basis_) : ""; !why.empty()) {
    if (!is_empty(header)) put_aside(why);
    header.first = header.end = 0;
  }
  end_ = header.end;
  kept_.first = header.first;
  for (std::uint64_t number = header.first; number < header.end; ++number) {
    if (auto point = read_point(number)) {
      kept_.points.push_back(std::move(*point));
    } else {
      kept_ = {number + 1, {}};
    }
  }
  if (!write_header(kept_.first, end_))
    throw std::runtime_error("--retract-path: '" + path_ + "': cannot be written: " + std::strerror(errno));
}

std::optional<arbiter::WayPoint> RetractPathFile::read_point(std::uint64_t number) const {
  std::vector<std::uint64_t> record(joints_ + 3);
  const std::uint64_t offset = kHeaderBytes + (number % arbiter::kMaxRetractPoints) * record_bytes();
  if (!read_at(fd_, record.data(), record_bytes(), offset)) return std::nullopt;
  if (record[0] != number || record.back() != crc_of(record.data(), record_bytes() - 8)) return std::nullopt;
  arbiter::WayPoint point{record[1] != 0, std::vector<double>(joints_)};
  std::memcpy(point.joint_rad.data(), &record[2], 8 * joints_);
  const auto is_finite = [](double angle_rad) { return std::isfinite(angle_rad); };
  if (!std::all_of(point.joint_rad.begin(), point.joint_rad.end(), is_finite)) return std::nullopt;
  return point;
}

bool RetractPathFile::write_point(std::uint64_t number, const arbiter::WayPoint& point) {
  std::vector<std::uint64_t> record(joints_ + 3);
  record[0] = number;
  record[1] = point.begins ? 1 : 0;
  std::memcpy(&record[2], point.joint_rad.data(), 8 * joints_);
  record.back() = crc_of(record.data(), record_bytes() - 8);
  return write_at(fd_, record.data(), record_bytes(),
                  kHeaderBytes + (number % arbiter::kMaxRetractPoints) * record_bytes());
}

bool RetractPathFile::write_header(std::uint64_t first, std::uint64_t end) {
  Header header;
  std::copy(kMagic.begin(), kMagic.end(), header.magic.begin());
  header.joints = static_cast<std::uint16_t>(joints_);
  header.first = first;
  header.end = end;
  header.basis = basis_;
  header.crc = crc_of(header);
  return write_at(fd_, &header, sizeof header, 0);
}

// Changes that wait become one.
void RetractPathFile::follow(const arbiter::WayChange& change) {
  {
    const std::lock_guard lock(mutex_);
    if (!problem_.empty()) return;
    if (!waiting_) waiting_ = arbiter::WayChange{change.first, change.kept, {}};
    arbiter::WayChange& all = *waiting_;
    all.first = change.first;
    if (change.kept < all.kept) all.kept = change.kept;
    all.added.resize(std::min<std::size_t>(all.added.size(), change.kept - all.kept));
    all.added.insert(all.added.end(), change.added.begin(), change.added.end());
  }
  wake_.notify_one();
}

std::optional<event::Event> RetractPathFile::trouble() {
  const std::lock_guard lock(mutex_);
  event::Event event{.kind = event::EventKind::kHostWarning,
                     .number = event::number_of(event::HostTroubleEvent::kWayFile),
                     .subject = path_,
                     .text = std::exchange(unused_, "")};
  if (!event.text.empty()) return event;
  if (problem_.empty() || std::exchange(told_, true)) return std::nullopt;
  event.text =
      "the way back is not kept in " + path_ + " any more: " + problem_ + "; free space there and start lianad again";
  return event;
}

void RetractPathFile::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ending_ || waiting_; });
    if (!waiting_) return;
    const arbiter::WayChange change = std::move(*std::exchange(waiting_, std::nullopt));
    lock.unlock();
    const bool good = write(change);
    const int reason = errno;
    if (!good) ::unlink(path_.c_str());  // rather none than one that is not true
    lock.lock();
    if (!good) problem_ = std::strerror(reason);
  }
}

// No header ever speaks of a point that is not there, or no longer.
bool RetractPathFile::write(const arbiter::WayChange& change) {
  if (change.kept < end_ && !write_header(std::min(change.first, change.kept), change.kept)) return false;
  end_ = change.kept;
  for (const arbiter::WayPoint& point : change.added) {
    if (!write_point(end_, point)) return false;
    ++end_;
  }
  if (!write_header(change.first, end_)) return false;
  unsynced_ += change.added.size();
  if (unsynced_ >= kPointsPerSync) {
    ::fdatasync(fd_);
    unsynced_ = 0;
  }
  return true;
}

}  // namespace liana::server
