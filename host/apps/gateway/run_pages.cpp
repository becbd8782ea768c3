#include "host/apps/gateway/run_pages.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "host/apps/gateway/proof.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {
namespace {

namespace fs = std::filesystem;

bool is_run_name(const std::string& text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !text.empty() && text.front() != '.' && text.front() != '-' && std::all_of(text.begin(), text.end(), allowed);
}

}  // namespace

Json run_list(const std::string& folder, std::string_view ticket) {
  std::vector<std::pair<std::int64_t, std::string>> runs;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    struct stat status {};
    const std::string name = entry.path().filename();
    if (is_run_name(name) && stat(entry.path().c_str(), &status) == 0 && S_ISDIR(status.st_mode))
      runs.emplace_back(status.st_mtim.tv_sec, name);
  }
  std::sort(runs.rbegin(), runs.rend());
  Json list = Json::array();
  for (const auto& [changed_s, name] : runs) {
    list.push_back({{"name", name}, {"changed_s", changed_s}, {"page", run_page(folder, name).has_value()}});
    if (!ticket.empty()) list.back()["ticket"] = run_ticket(ticket, name);
  }
  return list;
}

std::optional<std::string> run_page(const std::string& folder, const std::string& name) {
  const std::string file = folder + "/" + name + "/page.html";
  std::error_code none;
  if (!is_run_name(name) || !fs::is_regular_file(fs::symlink_status(file, none))) return std::nullopt;
  return file;
}

}  // namespace liana::gateway
