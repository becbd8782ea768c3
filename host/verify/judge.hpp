// Compares predicted values with limits, for both verification ends.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "host/verify/verdict.hpp"

namespace liana::verify {

constexpr double kRounding = 1.0 + 1e-6;  // limits that the limiter reaches exactly

// Remembers the first failure and the tightest pass in its verdict. Texts are made where something is refused and, of
// the tightest pass, by `conclude`: hundreds of ticks are looked at, of which one says something.
class Judge {
 public:
  explicit Judge(Verdict& verdict) : verdict_(verdict) {}

  // Whatever is refused comes nearer to its limit than all that passed before it, and what is no number to neither
  // side.
  void check(Refusal code, const char* what, int index, double value, double limit) {
    const double share = std::fabs(value) / limit;
    if (!(share <= verdict_.share)) tighten(code, {what, index, share}, value, limit);
  }
  void require(bool good, Refusal code, const char* what, int index = -1) {
    if (!good) refuse(code, describe({what, index, 0.0}));
  }
  // The first refusal stands.
  void refuse(Refusal code, const std::string& text) {
    if (!verdict_.passed()) return;
    verdict_.code = code;
    verdict_.text = text;
  }
  // To be called once, at the end: writes down where the motion came nearest to a limit.
  void conclude() {
    if (tightest_.what == nullptr) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", tightest_.share);
    verdict_.margin = describe(tightest_) + ": " + text + " of the limit";
  }

 private:
  struct Pass {
    const char* what = nullptr;
    int index = -1;  // < 0: there is only one
    double share = 0.0;
  };

  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }
  static std::string describe(const Pass& pass) {
    return pass.index < 0 ? pass.what : pass.what + std::string(" ") + std::to_string(pass.index + 1);
  }
  void tighten(Refusal code, const Pass& pass, double value, double limit) {
    if (!std::isfinite(value)) return refuse(Refusal::kNotFinite, describe(pass) + " is not a finite number");
    verdict_.share = pass.share;
    tightest_ = pass;
    if (std::fabs(value) > limit * kRounding)
      refuse(code, describe(pass) + " = " + number(value) + ", allowed " + number(limit));
  }

  Verdict& verdict_;
  Pass tightest_;
};

}  // namespace liana::verify
