#include "host/control/server/loss_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "host/base/file/out_file.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/field.hpp"

namespace liana::server {
namespace {

std::vector<std::size_t> cables_in(const Json& content, std::size_t drives) {
  std::vector<std::size_t> cables;
  for (const Json& each : content.at("lost_cables")) {
    const std::int64_t number = each.get<std::int64_t>();
    if (number < 1 || number > static_cast<std::int64_t>(drives)) throw std::runtime_error("no such cable");
    cables.push_back(static_cast<std::size_t>(number - 1));
  }
  std::sort(cables.begin(), cables.end());
  return cables;
}

}  // namespace

LossFile::LossFile(std::string path, std::string robot, std::size_t drives)
    : path_(std::move(path)), robot_(std::move(robot)) {
  if (!std::filesystem::exists(path_)) return;
  try {
    const Json content = Json::parse(config::read_text_file(path_));
    if (content.at("robot").text() == robot_) cables_ = cables_in(content, drives);
  } catch (const std::exception& error) {
    throw std::runtime_error("'" + path_ + "' should say which cables the arm has lost: " + error.what() +
                             "; look at every cable, then remove the file");
  }
}

// Who is killed loses nothing by it; who loses power may, and finds the arm by hand.
bool LossFile::note(const std::vector<std::size_t>& cables) {
  try {
    if (cables.empty()) {
      std::filesystem::remove(path_);
    } else {
      Json numbers = Json::array();
      for (const std::size_t cable : cables) numbers.push_back(cable + 1);
      file::OutFile out(path_);
      out.write(Json{{"robot", robot_}, {"lost_cables", numbers}}.dump() + "\n");
      out.finish();
    }
  } catch (const std::runtime_error&) {
    return false;
  }
  cables_ = cables;
  return true;
}

}  // namespace liana::server
