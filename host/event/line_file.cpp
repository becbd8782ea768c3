#include "host/event/line_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace liana::event {
namespace {

std::uint64_t lines_of_events(std::string_view text) {
  std::uint64_t lines = 0;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) lines += text[begin] != '#';
  return lines;
}

Event event_of_file(HostTroubleEvent what, const std::string& path, std::uint64_t missing, const std::string& text) {
  return {.kind = EventKind::kHostTrouble,
          .number = number_of(what),
          .subject = path,
          .values = {{"count", static_cast<double>(missing)}},
          .text = text};
}

}  // namespace

// A path that nobody reads at the other end (a pipe) is an error of opening, not a wait.
LineFile::LineFile(const std::string& path, const char* option, const char* heading)
    : path_(path),
      fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0644)),
      waiting_("#" + std::string(heading) + "\n") {
  if (fd_ < 0)
    throw std::runtime_error(std::string(option) + ": '" + path + "': cannot be written: " + std::strerror(errno) +
                             "; give a file in a folder that exists");
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
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() + line.size() > kMostWaiting) {
      ++missing_;
      failing_ = true;
      why_ = "the disk is too slow";
      return;
    }
    say_missing();
    waiting_ += line;
  }
  wake_.notify_one();
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
    if (waiting_.empty()) return;
    const std::string text = std::exchange(waiting_, {});
    lock.unlock();
    int reason = 0;
    const std::size_t done = write_all(text, reason);
    lock.lock();
    take_result(text, done, reason);
  }
}

// How much of the text is in the file: whole lines only.
std::size_t LineFile::write_all(std::string_view text, int& reason) {
  std::size_t done = 0;
  while (done < text.size() && reason == 0) {
    const bool has_room = bytes_ + text.size() <= kMostBytes;
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
