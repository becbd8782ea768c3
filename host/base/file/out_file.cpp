#include "host/base/file/out_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <tuple>

namespace liana::file {
namespace {

namespace fs = std::filesystem;

// Names of what is not finished, for a signal's handler; one beyond the last would stay behind then.
std::array<std::atomic<const char*>, 4> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

void note(const char* path) {
  for (auto& slot : unfinished) {
    const char* free = nullptr;
    if (slot.compare_exchange_strong(free, path)) return;
  }
}

void forget(const char* path) {
  for (auto& slot : unfinished) {
    const char* noted = path;
    if (slot.compare_exchange_strong(noted, nullptr)) return;
  }
}

// At once: whatever comes between would leave its own reason.
[[noreturn]] void refuse(const std::string& path, const char* problem) {
  throw std::runtime_error(path + ": " + problem + ": " + std::strerror(errno));
}

// Where a link leads: it is the file that is replaced, not the link.
std::string target_of(const std::string& path) {
  std::error_code unknown;
  const fs::path target = fs::is_symlink(path, unknown) ? fs::weakly_canonical(path, unknown) : fs::path(path);
  return unknown ? path : target.string();
}

}  // namespace

OutFile::OutFile(const std::string& path) : path_(target_of(path)), written_(path_) {
  struct stat replaced {};
  const bool is_there = ::stat(path_.c_str(), &replaced) == 0;
  if (!is_there || S_ISREG(replaced.st_mode)) {
    const std::string beside = path_ + ".part-" + std::to_string(::getpid());
    const int fd = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd >= 0) {
      if (is_there) std::ignore = ::fchmod(fd, replaced.st_mode & 07777);
      written_ = beside;
      is_beside_ = true;
      file_.reset(::fdopen(fd, "wb"));
      note(written_.c_str());
    }
  }
  if (!file_) file_.reset(std::fopen(path_.c_str(), "wbe"));
  if (!file_) refuse(path_, "cannot be made");
}

OutFile::~OutFile() {
  if (!is_beside_) return;
  ::unlink(written_.c_str());
  forget(written_.c_str());
}

void OutFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) refuse(path_, "cannot be written");
}

void OutFile::finish() {
  if (std::fflush(file_.get()) != 0) refuse(path_, "cannot be written");
  if (!is_beside_) return;
  if (std::rename(written_.c_str(), path_.c_str()) != 0) refuse(path_, "cannot be written");
  forget(written_.c_str());
  is_beside_ = false;
}

void remove_unfinished() noexcept {
  for (auto& slot : unfinished) {
    if (const char* path = slot.load()) ::unlink(path);
  }
}

}  // namespace liana::file
