// A file that is written in one go: what the disk refused is said at the end.
#pragma once

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace liana::archive {

class OutFile {
 public:
  explicit OutFile(const std::string& path) : path_(path), file_(path, std::ios::binary) { require("cannot be made"); }
  void write(std::string_view text) { file_.write(text.data(), static_cast<std::streamsize>(text.size())); }
  void finish() {
    file_.flush();
    require("cannot be written");
  }

 private:
  void require(const char* problem) const {
    if (!file_) throw std::runtime_error(path_ + ": " + problem + ": " + std::strerror(errno));
  }
  std::string path_;
  std::ofstream file_;
};

}  // namespace liana::archive
