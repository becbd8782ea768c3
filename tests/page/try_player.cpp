// Steers the arm of the page "try it" without a browser: what the same code does natively, for tests/page.
// Standard input: buses, robot and scene as canonical JSON (liana-mission eval), a line each, then the script.
// A line of the script: how many command intervals, a request (liana::Request) that acts in the first of them, and the
// pose that is wanted, as liana_try_interval takes it: COUNT REQUEST WANTED X Y Z QW QX QY QZ. After each line the
// state is printed, and at the end the hash.
#include <cstdio>
#include <cstring>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "host/apps/web/core/try.hpp"

namespace {

std::string text(std::uint32_t bytes) { return {liana_try_place(), bytes}; }

std::string table() {
  std::string line;
  if (!std::getline(std::cin, line)) throw std::runtime_error("try_player: it takes three tables and a script");
  return line + "\n";
}

}  // namespace

int main() try {
  std::string tables;
  for (int i = 0; i < 3; ++i) tables += table();
  std::memcpy(liana_try_room(static_cast<std::uint32_t>(tables.size())), tables.data(), tables.size());
  liana_try_begin();
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream in(line);
    std::uint32_t intervals = 0, request = 0, wanted = 0;
    double pose[7];
    in >> intervals >> request >> wanted;
    for (double& number : pose) in >> number;
    if (!in) throw std::runtime_error("try_player: '" + line + "' is no line of a script; allowed: ten numbers");
    for (std::uint32_t i = 0; i < intervals; ++i) {
      liana_try_interval(i == 0 ? request : 0, wanted, pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], pose[6]);
    }
    std::puts(text(liana_try_state()).c_str());
  }
  std::puts(text(liana_try_hash()).c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
