// A text for one column of one line.
#pragma once

#include <algorithm>
#include <string>

namespace liana::event {

// Control characters become blanks; bytes beyond ASCII are parts of UTF-8 characters, and stay.
inline std::string on_one_line(std::string text) {
  const auto is_control = [](char c) { return (c >= 0 && c < 0x20) || c == 0x7F; };
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text;
}

}  // namespace liana::event
