#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "host/base/file/in_file.hpp"
#include "host/base/file/out_file.hpp"
#include "host/base/json/json.hpp"
#include "host/storage/archive/export.hpp"

namespace liana::archive {
namespace {

// A bus log, line by line: "(12.345678) can0 181#..."
class BusLog {
 public:
  explicit BusLog(const std::string& path) {
    file::require_ordinary(path);
    file_.open(path);
    next();
  }
  void next() { has_line_ = static_cast<bool>(std::getline(file_, line_)); }
  bool has_line() const { return has_line_; }
  const std::string& line() const { return line_; }
  double time_s() const { return line_.empty() ? 0.0 : std::strtod(line_.c_str() + 1, nullptr); }

 private:
  std::ifstream file_;
  std::string line_;
  bool has_line_ = false;
};

std::vector<std::unique_ptr<BusLog>> logs_of(const Reader& reader) {
  std::vector<std::unique_ptr<BusLog>> logs;
  const Json buses = Json::parse(reader.life().buses);
  for (const Json& bus : buses.at("buses"))
    logs.push_back(std::make_unique<BusLog>(reader.folder() + "/" + bus.at("name").text() + ".log"));
  std::erase_if(logs, [](const auto& log) { return !log->has_line(); });
  return logs;
}

// The line with its time counted from `zero_s`.
std::string line_at(const BusLog& log, double zero_s) {
  if (zero_s == 0.0) return log.line() + "\n";
  char time[40];
  std::snprintf(time, sizeof time, "(%.6f", zero_s + log.time_s());
  return time + log.line().substr(log.line().find(')')) + "\n";
}

BusLog* earliest(const std::vector<std::unique_ptr<BusLog>>& logs) {
  BusLog* found = nullptr;
  for (const auto& log : logs) {
    if (log->has_line() && (found == nullptr || log->time_s() < found->time_s())) found = log.get();
  }
  return found;
}

}  // namespace

std::uint64_t write_candump(const Reader& reader, Span span, const std::string& path, double zero_s) {
  const auto logs = logs_of(reader);
  if (logs.empty())
    throw std::runtime_error(reader.folder() +
                             ": holds no bus traffic; runs with --record have it, and those that failed");
  const double from_s = static_cast<double>(span.first) * reader.life().period_s;
  const double to_s = static_cast<double>(span.last) * reader.life().period_s;
  file::OutFile out(path);
  std::uint64_t frames = 0;
  for (BusLog* log = earliest(logs); log != nullptr && log->time_s() <= to_s; log = earliest(logs)) {
    if (log->time_s() >= from_s) {
      out.write(line_at(*log, zero_s));
      ++frames;
    }
    log->next();
  }
  out.finish();
  return frames;
}

}  // namespace liana::archive
