// truth.bin: what the physics really did, one row per slot (docs/reference/formats.md).
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace liana::bench {

class TruthLog {
 public:
  // An empty path writes nothing. Throws std::runtime_error when the file cannot be created.
  TruthLog(const std::string& path, const std::vector<std::string>& columns);
  // One row in the order of the columns; throws std::runtime_error when the row has another length or the disk is full.
  void write(const std::vector<double>& row);
  // Hands all rows to the system; throws std::runtime_error when the disk is full.
  void flush();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::size_t columns_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace liana::bench
