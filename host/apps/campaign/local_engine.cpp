#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "host/apps/campaign/engine.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/base/file/in_file.hpp"

namespace liana::campaign {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxTries = 3;  // of a row whose run was killed, or whose programs did not start
constexpr double kEndGrace_s = 10.0;
constexpr auto kLook = std::chrono::milliseconds(20);

// Names of folders that chance has chosen are no part of a report.
std::string without_scratch(std::string text, const std::string& scratch) {
  constexpr std::string_view kInner = "/t/liana-run-";
  constexpr std::size_t kRandom = 6;
  for (std::size_t at = text.find(scratch); at != text.npos; at = text.find(scratch, at)) {
    std::size_t size = scratch.size();
    if (text.compare(at + size, kInner.size(), kInner) == 0) size += kInner.size() + kRandom;
    text.erase(at, size);
  }
  return text;
}

// One row under way.
struct Slot {
  Row row;
  std::string folder;
  std::unique_ptr<launcher::ChildProcess> run;
};

class Workers {
 public:
  Workers(Rows& rows, const Order& order, const TakeResult& take, const Say& say)
      : rows_(rows),
        order_(order),
        take_(take),
        say_(say),
        scratch_(launcher::temporary_directory()),
        waiting_(order.rows.begin(), order.rows.end()) {}
  ~Workers() {
    for (const auto& [number, slot] : busy_) slot.run->ask_to_end();
    for (const auto& [number, slot] : busy_) slot.run->end(kEndGrace_s);
    busy_.clear();
    std::error_code gone;
    fs::remove_all(scratch_, gone);
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  bool is_done() const { return waiting_.empty() && busy_.empty(); }

  void fill(std::size_t jobs) {
    while (busy_.size() < jobs && !waiting_.empty()) {
      const std::uint64_t number = waiting_.front();
      waiting_.pop_front();
      ++tries_[number];
      busy_.emplace(number, start(number));
    }
  }

  void look() {
    for (auto at = busy_.begin(); at != busy_.end();) {
      const std::optional<launcher::ExitStatus> end = at->second.run->poll();
      if (!end) {
        ++at;
        continue;
      }
      finish(at->second, *end);
      at = busy_.erase(at);
    }
  }

 private:
  Slot start(std::uint64_t number) {
    Slot slot{rows_.at(number), scratch_ + "/" + std::to_string(number), nullptr};
    for (const char* below : {"", "/t", "/state", "/runtime"}) {
      fs::create_directories(slot.folder + below);
      fs::permissions(slot.folder + below, fs::perms::owner_all);
    }
    for (const auto& [file, text] : slot.row.tables) launcher::write_output(slot.folder + "/" + file, text);
    std::vector<std::string> argv{kEnv,
                                  "-C",
                                  slot.folder,
                                  "TMPDIR=" + slot.folder + "/t",
                                  "XDG_STATE_HOME=" + slot.folder + "/state",
                                  "XDG_RUNTIME_DIR=" + slot.folder + "/runtime",
                                  launcher::sibling_program("liana")};
    argv.insert(argv.end(), slot.row.words.begin(), slot.row.words.end());
    argv.emplace_back("--json=report.json");
    if (order_.full_folder.empty()) {
      argv.emplace_back("--lean");
    } else {
      const std::string kept = folder_of_row(order_.full_folder, number);
      fs::remove_all(kept);  // of a try that was killed
      fs::create_directories(order_.full_folder);
      argv.push_back("--record=" + kept);
    }
    slot.run = std::make_unique<launcher::ChildProcess>("liana", argv, slot.folder + "/log");
    return slot;
  }

  void finish(const Slot& slot, const launcher::ExitStatus& end) {
    const std::uint64_t number = slot.row.number;
    const Json report =
        Json::parse_or_null(without_scratch(file::content_of(slot.folder + "/report.json").value_or(""), slot.folder));
    const bool is_refused = end.signal == 0 && end.code == launcher::kExitBadInput;
    const bool has_begun = report.is_object() && report.value("ticks", 0) > 0;
    const std::string words = without_scratch(slot.run->last_words(), slot.folder);
    if (is_refused || (has_begun && end.signal == 0 && end.code != launcher::kExitInterrupted)) {
      take_(result_of(slot, end, report, words));
    } else if (tries_[number] < kMaxTries) {
      waiting_.push_back(number);
    } else {
      say_("row " + std::to_string(number) + " has no result after " + std::to_string(kMaxTries) + " tries: its run " +
           launcher::how(end) + words);
    }
    std::error_code gone;
    fs::remove_all(slot.folder, gone);
  }

  static RowResult result_of(const Slot& slot, const launcher::ExitStatus& end, const Json& report,
                             const std::string& words) {
    RowResult result;
    result.number = slot.row.number;
    result.config_hash = slot.row.config_hash;
    result.exit_code = end.code;
    result.cpu_s = slot.run->cpu_s();
    result.outcome = report.is_object() ? report.value("outcome", "failed") : "refused";
    if (report.is_object()) {
      result.report_hash = report_hash(report);
      result.figures = figures_of(report);
      const Json& reason = report.member_or_null("reason");
      if (reason.is_string()) result.reason = reason.text();
    }
    if (result.outcome != "success" && result.reason.empty())
      result.reason = words.starts_with(": ") ? words.substr(2) : words;
    return result;
  }

  Rows& rows_;
  const Order& order_;
  const TakeResult& take_;
  const Say& say_;
  std::string scratch_;
  std::deque<std::uint64_t> waiting_;
  std::map<std::uint64_t, Slot> busy_;
  std::map<std::uint64_t, int> tries_;
};

}  // namespace

void LocalEngine::run(const Order& order, const TakeResult& take) {
  Workers workers(rows_, order, take, say_);
  while (!workers.is_done() && interrupts_.count() == 0) {
    workers.fill(jobs_);
    std::this_thread::sleep_for(kLook);
    workers.look();
  }
}

std::size_t processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return std::max(1u, std::thread::hardware_concurrency());
  return static_cast<std::size_t>(std::max(1, CPU_COUNT(&allowed)));
}

std::string folder_of_row(const std::string& full_folder, std::uint64_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "/row-%06llu", static_cast<unsigned long long>(number));
  return full_folder + name;
}

}  // namespace liana::campaign
