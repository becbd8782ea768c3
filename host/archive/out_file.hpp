// A file that is written in one go: the first thing that the disk refused is said, with its reason.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace liana::archive {

class OutFile {
 public:
  // Throws std::runtime_error with path and reason, as write() and finish() do.
  explicit OutFile(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) refuse("cannot be made");
  }
  void write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) refuse("cannot be written");
  }
  void finish() {
    if (std::fflush(file_.get()) != 0) refuse("cannot be written");
  }

 private:
  // At once: whatever comes between would leave its own reason.
  [[noreturn]] void refuse(const char* problem) const {
    throw std::runtime_error(path_ + ": " + problem + ": " + std::strerror(errno));
  }
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace liana::archive
