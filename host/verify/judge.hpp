// Compares predicted values with limits, for both verification ends.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "host/verify/verdict.hpp"

namespace liana::verify {

constexpr double kRounding = 1.0 + 1e-6;  // limits that the limiter reaches exactly

// Remembers the first failure and the tightest pass in its verdict.
class Judge {
 public:
  explicit Judge(Verdict& verdict) : verdict_(verdict) {}

  void check(Refusal code, const char* what, int index, double value, double limit) {
    if (!std::isfinite(value)) return refuse(Refusal::kNotFinite, describe(what, index) + " is not a finite number");
    const double share = std::fabs(value) / limit;
    if (share > verdict_.share) {
      verdict_.share = share;
      char text[32];
      std::snprintf(text, sizeof text, "%.3f", share);
      verdict_.margin = describe(what, index) + ": " + text + " of the limit";
    }
    if (std::fabs(value) > limit * kRounding)
      refuse(code, describe(what, index) + " = " + number(value) + ", allowed " + number(limit));
  }
  void require(bool good, Refusal code, const std::string& text) {
    if (!good) refuse(code, text);
  }

 private:
  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }
  static std::string describe(const char* what, int index) {
    return index < 0 ? what : what + std::string(" ") + std::to_string(index + 1);
  }
  void refuse(Refusal code, const std::string& text) {
    if (!verdict_.passed()) return;
    verdict_.code = code;
    verdict_.text = text;
  }

  Verdict& verdict_;
};

}  // namespace liana::verify
