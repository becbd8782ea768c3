#include "host/apps/launcher/interrupt.hpp"

#include <unistd.h>

#include <string_view>

#include "host/apps/launcher/errors.hpp"
#include "host/base/file/out_file.hpp"

namespace liana::launcher {
namespace {

std::atomic<int> interrupts = 0;
std::atomic<bool> interrupted = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void count_interrupt(int) {
  ++interrupts;
  interrupted = true;
}

void end(int) {
  constexpr std::string_view kText = "liana: interrupted\n";
  file::remove_unfinished();
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kText.data(), kText.size());
  _exit(kExitInterrupted);
}

}  // namespace

void end_on_interrupt() {
  if (std::signal(SIGINT, end) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

InterruptGuard::InterruptGuard() {
  interrupts = 0;
  interrupted = false;
  before_int_ = std::signal(SIGINT, count_interrupt);
  before_term_ = std::signal(SIGTERM, count_interrupt);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, before_int_);
  std::signal(SIGTERM, before_term_);
}

int InterruptGuard::count() const { return interrupts; }
const std::atomic<bool>& InterruptGuard::any() const { return interrupted; }

}  // namespace liana::launcher
