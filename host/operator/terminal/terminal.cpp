#include "host/operator/terminal/terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace liana::terminal {
namespace {

constexpr const char* kOtherScreen = "\x1b[?1049h\x1b[?25l";   // and no cursor
constexpr const char* kFormerScreen = "\x1b[?25h\x1b[?1049l";  // with its cursor
constexpr const char* kToTop = "\x1b[H";
constexpr const char* kRestOfLine = "\x1b[K";
constexpr const char* kNextLine = "\r\n";  // not after the last one, where it would scroll
constexpr const char* kRestOfScreen = "\x1b[J";

}  // namespace

Terminal::Terminal() {
  const char* name = ttyname(STDOUT_FILENO);
  if (name == nullptr || tcgetattr(STDIN_FILENO, &before_) != 0)
    throw std::runtime_error("standard input and output have to be a terminal: keys are read one by one");
  out_ = open(name, O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (out_ < 0) throw std::runtime_error(std::string("the terminal ") + name + " cannot be opened");
  termios raw = before_;
  raw.c_iflag &= ~static_cast<tcflag_t>(IXON);                  // Ctrl-S would stop the picture
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);  // Ctrl-C is a key: the arm holds before we end
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  put(kOtherScreen);
}

Terminal::~Terminal() {
  put(kFormerScreen);
  close(out_);
  tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

std::string Terminal::read(int other_fd, double timeout_s) {
  std::array<pollfd, 2> waited{{{STDIN_FILENO, POLLIN, 0}, {other_fd, POLLIN, 0}}};
  poll(waited.data(), waited.size(), static_cast<int>(std::ceil(1e3 * timeout_s)));
  if (waited[0].revents == 0) return {};
  std::array<char, 256> bytes{};
  const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  is_gone_ = count <= 0;
  return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

void Terminal::draw(const std::vector<std::string>& lines) {
  std::string text = kToTop;
  for (std::size_t i = 0; i < lines.size(); ++i) text += (i > 0 ? kNextLine : "") + lines[i] + kRestOfLine;
  text += kRestOfScreen;
  put(text);
}

void Terminal::put(const std::string& text) const {
  [[maybe_unused]] const ssize_t count = write(out_, text.data(), text.size());
}

Size Terminal::size() const {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

}  // namespace liana::terminal
