// What happens in a run as a text file, line by line, in parts of a bounded size: FILE.first has the begin of the run
// and stays, FILE.before is the part before the newest, FILE the newest. A thread of its own writes it: whoever notes
// an event never waits for a disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "host/base/event/event.hpp"

namespace liana::event {

class LineFile {
 public:
  static constexpr std::size_t kMaxWaitingBytes = 1u << 20;  // bytes for the disk; beyond it events are missing
  static constexpr std::uint64_t kPartBytes = 32u << 20;     // of a part: three of them at most
  static constexpr const char* kFirst = ".first";
  static constexpr const char* kBefore = ".before";

  // Makes the file, or empties it; its first line is `heading`. Parts of an earlier run go. Throws std::runtime_error,
  // naming `option`, when it cannot be opened; a disk that is full by then is no reason not to run.
  LineFile(const std::string& path, const char* option, const char* heading, std::uint64_t part_bytes = kPartBytes);
  // Writes what waits.
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  // Hands a line, without its end, to the thread.
  void append(std::string line);
  // The line that each further part repeats behind its heading: the cause of what goes on.
  void repeat(std::string line);
  // What has changed since the last call, for the log: the disk takes no more, or it takes events again. Both are of
  // kind host_warning. Events that were lost on the way are missing in the file; a line beginning with # says how many
  // so far.
  std::optional<Event> change();

 private:
  void work();
  std::string next_lines();
  std::size_t write_all(std::string_view text, int& reason);
  void take_result(std::string_view text, std::size_t done, int reason);
  void say_missing();
  void begin_part();
  std::string beginning();

  std::string path_, heading_;
  const std::uint64_t part_bytes_;
  int fd_;
  bool rotates_;             // no pipe or device
  std::uint64_t bytes_ = 0;  // in the newest part; of the thread alone, as are the parts

  std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::string waiting_;
  std::string repeated_;
  std::uint64_t missing_ = 0;                          // events that are not in the file
  std::uint64_t missing_said_ = 0, missing_told_ = 0;  // of them: in the file, and by change()
  bool failing_ = false, failing_told_ = false;
  std::string why_;  // of the last failure
  bool ending_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace liana::event
