// Running liana-mission as users do.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/temporary_folder.hpp"

namespace liana::mission_runner {

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// How a program ended and what it said.
struct Ended {
  int code = -1;
  std::string out;
  std::string error;
};

// Runs liana-mission with these arguments (quoted for the shell by the caller).
inline Ended run_program(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command =
      std::string(LIANA_MISSION) + " " + arguments + " >" + folder.file("out") + " 2>" + folder.file("err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder.file("out")), read_file(folder.file("err"))};
}

}  // namespace liana::mission_runner
