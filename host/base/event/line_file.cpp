#include "host/base/event/line_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace liana::event {
namespace {

constexpr std::chrono::milliseconds kGather{20};

std::uint64_t lines_of_events(std::string_view text) {
  std::uint64_t lines = 0;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) lines += text[begin] != '#';
  return lines;
}

Event event_of_file(HostTroubleEvent what, const std::string& path, std::uint64_t missing, const std::string& text) {
  return {.kind = EventKind::kHostWarning,
          .number = number_of(what),
          .subject = path,
          .values = {{"count", static_cast<double>(missing)}},
          .text = text};
}

// 0644, whatever else is said of it; `exclusive`: O_EXCL, or 0.
int opened(const std::string& path, int exclusive) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_NONBLOCK | O_CLOEXEC | exclusive, 0644);
}

bool is_plain_file(int fd) {
  struct stat found {};
  return fd >= 0 && ::fstat(fd, &found) == 0 && S_ISREG(found.st_mode);
}

}  // namespace

// A path that nobody reads at the other end (a pipe) is an error of opening, not a wait.
LineFile::LineFile(const std::string& path, const char* option, const char* heading, std::uint64_t part_bytes)
    : path_(path),
      heading_("#" + std::string(heading) + "\n"),
      part_bytes_(part_bytes),
      fd_(opened(path, 0)),
      rotates_(is_plain_file(fd_)),
      waiting_(heading_) {
  if (fd_ < 0)
    throw std::runtime_error(std::string(option) + ": '" + path + "': cannot be written: " + std::strerror(errno) +
                             "; give a file in a folder that exists");
  if (rotates_) {
    ::unlink((path_ + kFirst).c_str());
    ::unlink((path_ + kBefore).c_str());
  }
  thread_ = std::thread([this] { work(); });
}

LineFile::~LineFile() {
  {
    const std::lock_guard lock(mutex_);
    say_missing();
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
  ::close(fd_);
}

void LineFile::append(std::string line) {
  line += "\n";
  bool is_first = false;
  {
    const std::lock_guard lock(mutex_);
    is_first = waiting_.empty();
    if (waiting_.size() + line.size() > kMaxWaitingBytes) {
      ++missing_;
      failing_ = true;
      why_ = "the disk is too slow";
      return;
    }
    say_missing();
    waiting_ += line;
  }
  if (is_first) wake_.notify_one();
}

void LineFile::repeat(std::string line) {
  const std::lock_guard lock(mutex_);
  repeated_ = std::move(line) + "\n";
}

void LineFile::say_missing() {
  if (missing_ == missing_said_) return;
  missing_said_ = missing_;
  waiting_ += "# " + std::to_string(missing_) + " events are missing so far\n";
}

std::optional<Event> LineFile::change() {
  const std::lock_guard lock(mutex_);
  if (failing_ == failing_told_ && (failing_ || missing_ == missing_told_)) return std::nullopt;
  failing_told_ = failing_;
  missing_told_ = missing_;
  if (failing_)
    return event_of_file(HostTroubleEvent::kEventFile, path_, missing_,
                         "events are missing in " + path_ + ": " + why_ + "; free space there");
  return event_of_file(HostTroubleEvent::kEventFileGood, path_, missing_,
                       path_ + " takes events again; " + std::to_string(missing_) + " are missing in it");
}

void LineFile::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    wake_.wait_for(lock, kGather, [this] { return ending_; });  // lines that follow go with it
    if (waiting_.empty()) return;
    const std::string text = next_lines();
    lock.unlock();
    int reason = 0;
    const std::size_t done = write_all(text, reason);
    lock.lock();
    take_result(text, done, reason);
  }
}

// What waits, in whole lines: no more than a part holds.
std::string LineFile::next_lines() {
  if (waiting_.size() <= part_bytes_) return std::exchange(waiting_, {});
  const std::size_t last = waiting_.rfind('\n', part_bytes_ - 1);
  const std::size_t bytes = 1 + (last != std::string::npos ? last : waiting_.find('\n'));
  std::string text = waiting_.substr(0, bytes);
  waiting_.erase(0, bytes);
  return text;
}

std::string LineFile::beginning() {
  const std::lock_guard lock(mutex_);
  return heading_ + "# goes on from " + path_ + kFirst + " and " + kBefore + "; the first of what goes on:\n" +
         repeated_;
}

// The newest part makes room for another. Where that cannot be, it takes no more: a disk is not filled.
void LineFile::begin_part() {
  const bool is_first = ::access((path_ + kFirst).c_str(), F_OK) != 0;
  const bool moved = ::rename(path_.c_str(), (path_ + (is_first ? kFirst : kBefore)).c_str()) == 0;
  if (!moved && errno != ENOENT) return;
  const int fd = opened(path_, O_EXCL);
  if (fd < 0) return;
  ::close(std::exchange(fd_, fd));
  const std::string text = beginning();
  bytes_ = ::write(fd_, text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? text.size() : 0;
  if (bytes_ == 0 && ::ftruncate(fd_, 0) != 0) return;
}

// How much of the text is in the file: whole lines only.
std::size_t LineFile::write_all(std::string_view text, int& reason) {
  if (rotates_ && bytes_ > 0 && bytes_ + text.size() > part_bytes_) begin_part();
  std::size_t done = 0;
  while (done < text.size() && reason == 0) {
    const bool has_room = !rotates_ || bytes_ == 0 || bytes_ + text.size() <= part_bytes_ + kMaxWaitingBytes;
    const ssize_t count = has_room ? ::write(fd_, text.data() + done, text.size() - done) : -1;
    if (count >= 0) done += static_cast<std::size_t>(count);
    if (count < 0 && !(has_room && errno == EINTR)) reason = has_room ? errno : EFBIG;
  }
  if (reason != 0) done = text.substr(0, done).rfind('\n') + 1;
  bytes_ += done;
  if (reason != 0 && ::ftruncate(fd_, static_cast<off_t>(bytes_)) != 0) return done;  // no file: nothing to cut
  return done;
}

void LineFile::take_result(std::string_view text, std::size_t done, int reason) {
  failing_ = reason != 0;
  if (!failing_) return;
  why_ = std::strerror(reason);
  missing_ += lines_of_events(text.substr(done));
  missing_said_ = 0;  // the line that said so may be lost, too
}

}  // namespace liana::event
