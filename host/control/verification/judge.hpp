// Compares predicted values with limits, for both verification ends.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "firmware_like/math/trig.hpp"
#include "host/control/verification/verdict.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::verification {

constexpr double kRounding = 1.0 + 1e-6;  // limits that the limiter reaches exactly

// In which unit people are told of a quantity: those of missions and tables.
struct Unit {
  const char* name = "";
  double in_si = 1.0;
};
constexpr Unit kNewtons{"N", 1.0}, kMillimetres{"mm", 1e-3}, kMetresPerSecond{"m/s", 1.0}, kDegrees{"deg", kDegree},
    kDegreesPerSecond{"deg/s", kDegree};

// Remembers the first failure and the tightest pass in its verdict. Texts are made where something is refused and, of
// the tightest pass, by `conclude`: hundreds of ticks are looked at, of which one says something.
class Judge {
 public:
  // `cables`: of which arm a quantity whose name ends in "cable" is; nullptr: of none.
  explicit Judge(Verdict& verdict, const cable::RobotParams* cables = nullptr) : verdict_(verdict), cables_(cables) {}

  // `value` and `limit` are in SI units, `unit` is that of the text. Whatever is refused comes nearer to its limit than
  // all that passed before it, and what is no number to neither side.
  void check(Refusal code, const char* what, const Unit& unit, int index, double value, double limit) {
    const double share = std::fabs(value) / limit;
    if (!(share <= verdict_.share)) tighten(code, {what, index, share}, unit, value, limit);
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

  static std::string in(const Unit& unit, double value) {
    char text[48];
    std::snprintf(text, sizeof text, "%.6g %s", value / unit.in_si, unit.name);
    return text;
  }
  std::string describe(const Pass& pass) const {
    if (pass.index < 0) return pass.what;
    const std::string_view what = pass.what, cable = "cable";
    if (cables_ != nullptr && what.ends_with(cable))
      return std::string(what.substr(0, what.size() - cable.size())) +
             config::DriveNames(*cables_).cable(static_cast<std::size_t>(pass.index));
    return std::string(what) + " " + std::to_string(pass.index + 1);
  }
  void tighten(Refusal code, const Pass& pass, const Unit& unit, double value, double limit) {
    if (!std::isfinite(value)) return refuse(Refusal::kNotFinite, describe(pass) + " is not a finite number");
    verdict_.share = pass.share;
    tightest_ = pass;
    if (std::fabs(value) > limit * kRounding)
      refuse(code, describe(pass) + " = " + in(unit, value) + ", allowed " + in(unit, limit));
  }

  Verdict& verdict_;
  const cable::RobotParams* cables_;
  Pass tightest_;
};

}  // namespace liana::verification
