// A file that a command writes: whole under its name, or not at all. What the disk refuses is said with its reason.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace liana::file {

// Writes PATH.part-PID beside it; finish() gives it its name, with the permissions of the file that it replaces. What
// is not finished is removed, and an earlier file stays as it was. What is no ordinary file (a device, a pipe), and
// what lies in a folder in which nothing can be made, is written itself. Throws std::runtime_error with path and
// reason.
class OutFile {
 public:
  explicit OutFile(const std::string& path);
  ~OutFile();
  OutFile(const OutFile&) = delete;
  OutFile& operator=(const OutFile&) = delete;

  void write(std::string_view text);
  void finish();
  // The file beside it, for writers that open it themselves and have ended before finish().
  const std::string& unfinished_path() const { return written_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_, written_;
  std::unique_ptr<std::FILE, Close> file_;
  bool is_beside_ = false;
};

// Removes what is not finished, of a process that ends at once: may be called by a signal's handler.
void remove_unfinished() noexcept;

}  // namespace liana::file
