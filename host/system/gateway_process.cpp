#include "host/system/gateway_process.hpp"

#include <chrono>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "host/system/errors.hpp"
#include "host/system/runs.hpp"

namespace liana::system {
namespace {

constexpr const char* kUsual = "127.0.0.1:8765";
constexpr const char* kFreePort = "127.0.0.1:0";
constexpr const char* kSays = "liana-gateway: ";
constexpr double kPatience_s = 10.0;

// The last line with an address: a gateway that was started again has written another one.
std::string address_in(const std::string& log_file) {
  std::ifstream log(log_file);
  std::string address;
  for (std::string line; std::getline(log, line);) {
    if (line.starts_with("http") && !log.eof()) address = line;
  }
  return address;
}

std::string without_name(std::string text) {
  if (text.starts_with(kSays)) text.erase(0, std::string(kSays).size());
  return text;
}

}  // namespace

GatewayProcess::GatewayProcess(std::string api, GatewayOptions options, std::string log_file)
    : api_(std::move(api)), log_file_(std::move(log_file)), options_(std::move(options)) {
  try {
    start(options_.listen.empty() ? kUsual : options_.listen);
  } catch (const BadInput&) {
    if (!options_.listen.empty()) throw;
    start(kFreePort);
  }
}

void GatewayProcess::start(const std::string& listen) {
  std::vector<std::string> argv{sibling_program("liana-gateway"), "--api", api_, "--listen", listen};
  const auto add = [&argv](const char* option, const std::string& value) {
    if (!value.empty()) argv.insert(argv.end(), {option, value});
  };
  add("--token-file", options_.token_file);
  add("--cert", options_.certificate);
  add("--key", options_.key);
  add("--runs", runs_folder());
  child_ = std::make_unique<ChildProcess>("liana-gateway", argv, log_file_);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience_s);
  while (std::chrono::steady_clock::now() < deadline) {
    const std::optional<ChildEnd> end = child_->poll();
    if (end && end->code == kExitBadInput) throw BadInput(without_name(child_->last_lines(1)));
    if (end) throw std::runtime_error("liana-gateway " + how(*end) + "\n" + child_->last_lines(kShownLines));
    address_ = address_in(log_file_);
    if (!address_.empty()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("liana-gateway did not listen within 10 s\n" + child_->last_lines(kShownLines));
}

std::string GatewayProcess::revive() {
  const std::optional<ChildEnd> end = child_->poll();
  if (!end) return "";
  const std::string text = "liana-gateway " + how(*end);
  const std::size_t begin = address_.find("//") + 2;
  start(address_.substr(begin, address_.size() - begin - 1));
  return text;
}

}  // namespace liana::system
