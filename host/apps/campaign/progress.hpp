// How far a campaign is, on standard error: a live line on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace liana::campaign {

class Progress {
 public:
  // `rows` are still to be carried out.
  explicit Progress(std::uint64_t rows);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void row_done(bool is_success);
  // A line of its own.
  void say(const std::string& text);

 private:
  void show(bool is_last);
  void clear_live();

  bool terminal_;
  bool live_ = false;
  std::uint64_t rows_, done_ = 0, failed_ = 0;
  std::chrono::steady_clock::time_point begin_, next_;
};

// "1 h 05 min", "3 min 20 s" or "12 s".
std::string duration_text(double seconds);

}  // namespace liana::campaign
