#include "host/apps/launcher/output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "host/apps/launcher/errors.hpp"
#include "host/base/file/out_file.hpp"

namespace liana::launcher {
namespace {

bool can_be_written(const std::string& path) {
  struct stat status {};
  const bool is_there = stat(path.c_str(), &status) == 0;
  if (is_there && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return access(path.c_str(), W_OK) == 0;
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (fd < 0) return false;
  close(fd);
  if (!is_there) unlink(path.c_str());
  return true;
}

}  // namespace

void check_output(const std::string& option, const std::string& path) {
  if (path == "-")
    throw BadInput(option + ": '-': allowed: a file; standard output has the answer without this option");
  if (can_be_written(path)) return;
  const std::string reason = std::strerror(errno);
  throw BadInput(option + ": '" + path + "': cannot be written: " + reason +
                 "; give a file in a directory that exists");
}

void write_output(const std::string& path, const std::string& text) {
  file::OutFile out(path);
  out.write(text);
  out.finish();
}

int after_standard_output(int code) {
  errno = 0;
  std::cout.flush();  // of what prints by it: its stream may be another one than stdout is by now
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return code;
  const char* reason =
      errno != 0 ? std::strerror(errno) : "is the disk full?";  // of an earlier failure nobody has kept the reason
  std::fprintf(stderr, "liana: standard output cannot be written: %s\n", reason);
  return kExitFailure;
}

}  // namespace liana::launcher
