#include "hil/bench/truth_log.hpp"

#include <bit>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace liana::bench {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");

TruthLog::TruthLog(const std::string& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()) {
  if (path.empty()) return;
  file_.reset(std::fopen(path.c_str(), "wb"));
  if (!file_) throw std::runtime_error("--truth: " + path + " cannot be created; check the folder");
  const std::string header = nlohmann::json{{"columns", columns}}.dump() + "\n";
  std::fputs(header.c_str(), file_.get());
}

void TruthLog::write(const std::vector<double>& row) {
  if (!file_) return;
  if (row.size() != columns_)
    throw std::runtime_error("truth: a row of " + std::to_string(row.size()) + " values, expected " +
                             std::to_string(columns_));
  if (std::fwrite(row.data(), sizeof(double), row.size(), file_.get()) != row.size())
    throw std::runtime_error("--truth: writing " + path_ + " failed; is the disk full?");
}

void TruthLog::flush() {
  if (file_ && std::fflush(file_.get()) != 0)
    throw std::runtime_error("--truth: writing " + path_ + " failed; is the disk full?");
}

}  // namespace liana::bench
