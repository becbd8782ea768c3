#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/robot_new_questions.hpp"
#include "host/apps/cli/robot_new_start.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"

namespace liana::cli {
namespace {

constexpr double kHoleShare = 0.8;                         // of the radius, where the cables' holes are
constexpr double kHoleApart_m = 0.0015;                    // between neighbours among them; less in short modules:
constexpr double kHoleApartShare = 0.15;                   // of a module's length
constexpr double kUsualPlan_N = 30.0, kUsualJump_N = 7.0;  // of discs of 25 mm radius
constexpr double kMinPlan_N = 3.0;        // less is lost in a drive's friction and the steps of its torque
constexpr double kShortestLead_m = 0.1;   // drives are not smaller with the arm
constexpr double kThetaRate_deg_s = 2.0;  // no faster than the tip needs it
constexpr double kMinTipSpeed = 0.01;     // in arm lengths a second: a named pose is reached within its step's time
constexpr double kPoseBend_deg = 200.0;   // of the whole arm in `bent`, three quarters of it in `back`
constexpr double kShareOfAccel = 0.7;     // for the tip on its line; what is left catches up where the way gets harder
constexpr double kPlanStretch_m = 0.15e-3;  // of the shortest cable at plan_N, as of the usual arm

struct Answers {
  int segments = 0, modules = 0, cables = 0;
  double length_m = 0.0, radius_m = 0.0, theta_limit_deg = 0.0;
};

// What was given as an option; else what a person types, where one sits there; else the value in brackets.
class Asking {
 public:
  Asking() : is_person_(isatty(STDIN_FILENO) != 0) {}

  double number(const NumberQuestion& asked, const std::string& given, double usual) const {
    const std::string text = given.empty() ? typed(asked.question, usual, asked.unit) : given;
    return text.empty() ? usual : parse_number_in(asked.option, text, asked.least, asked.most, asked.unit);
  }
  int whole(const WholeQuestion& asked, const std::string& given) const {
    const std::string text = given.empty() ? typed(asked.question, asked.usual, "") : given;
    return text.empty() ? asked.usual : static_cast<int>(parse_whole(asked.option, text, asked.least, asked.most));
  }

 private:
  std::string typed(const char* question, double otherwise, const char* unit) const {
    std::string line;
    if (!is_person_) return line;
    std::fprintf(stderr, "%s? [%g%s%s] ", question, otherwise, *unit == '\0' ? "" : " ", unit);
    std::getline(std::cin, line);
    return line;
  }

  bool is_person_;
};

// Discs as wide as their links are long, in the proportion of the usual arm; wide enough for the holes of all cables.
double usual_radius_m(const Answers& answers) {
  const double apart_m = std::min(kHoleApart_m, kHoleApartShare * answers.length_m);
  const double holes_m = apart_m * answers.segments * answers.cables / (2.0 * std::numbers::pi * kHoleShare);
  const double proportionate_m = kAskRadius.usual * answers.length_m / kAskLength.usual;
  return std::clamp(std::round(1e4 * std::max(holes_m, proportionate_m)) / 1e4, kAskRadius.least, kAskRadius.most);
}

Answers ask(const RobotNewOptions& options) {
  const Asking asking;
  Answers answers;
  answers.segments = asking.whole(kAskSegments, options.segments);
  answers.modules = asking.whole(kAskModules, options.modules);
  answers.length_m = asking.number(kAskLength, options.module_length_m, kAskLength.usual);
  answers.cables = asking.whole(kAskCables, options.cables);
  answers.radius_m = asking.number(kAskRadius, options.radius_m, usual_radius_m(answers));
  answers.theta_limit_deg = asking.number(kAskLimit, options.theta_limit_deg, kAskLimit.usual);
  const int cables = answers.segments * answers.cables;
  if (cables > cable::kMaxCables)
    throw launcher::BadInput("--cables: " + std::to_string(answers.cables) + " in each of " +
                             std::to_string(answers.segments) + " segments are " + std::to_string(cables) +
                             ": allowed " + std::to_string(cable::kMaxCables) + " in all; give fewer");
  return answers;
}

std::string filled(const char* format, auto... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// Where the cables of a segment end, and by how much each segment's set is turned.
std::string holes(const Answers& a) {
  const std::string apart = "-- Each segment's set is turned so that no two cables share a hole.\n";
  if (a.cables == 4)
    return "-- No two holes of a segment are opposite each other: `liana calibrate` could not tell their cables "
           "apart.\n" +
           apart + "local hole_deg, turn_deg = { 0, 75, 150, 270 }, 75 / kSegments\n";
  return "-- The holes of a segment's cables are evenly spread.\n" + apart +
         (a.cables == 5 ? "local hole_deg, turn_deg = { 0, 72, 144, 216, 288 }, 72 / kSegments\n"
                        : "local hole_deg, turn_deg = { 0, 120, 240 }, 120 / kSegments\n");
}

std::string head(const std::string& name, const Answers& a) {
  const double bent_deg =
      std::min(0.4 * a.theta_limit_deg, kPoseBend_deg / (std::numbers::sqrt2 * a.segments * a.modules));
  return "-- " + name +
         ": written by `liana robot new`. What it asked for is marked; everything else is assumed from it, and yours "
         "to\n" +
         "-- correct (docs/how-to/bring-your-own-arm.md, docs/reference/formats.md). `liana robot check` says whether "
         "it fits.\n\n" +
         filled("local kSegments, kCables = %d, %d -- asked: segments, and cables that end in each\n", a.segments,
                a.cables) +
         filled("local segment = { modules = %d, module_length_m = %g, theta_limit_deg = %g } -- asked\n\n", a.modules,
                a.length_m, a.theta_limit_deg) +
         holes(a) +
         "local segments, phase_deg, direction, zero_counts = {}, {}, {}, {}\n"
         "for m = 1, kSegments do\n"
         "  segments[m], phase_deg[m] = segment, {}\n"
         "  for c = 1, kCables do\n"
         "    phase_deg[m][c] = hole_deg[c] + turn_deg * (m - 1)\n"
         "    direction[#direction + 1] = 1 -- counts grow while cable is paid out; -1 where a drum is mirrored\n"
         "    zero_counts[#zero_counts + 1] = 500000 -- what the drive reads with the arm straight; `liana calibrate` "
         "finds it\n"
         "  end\n"
         "end\n\n"
         "local zero, bent, back, wave = {}, {}, {}, {} -- poses: pitch, yaw of segment 1, 2, ...\n"
         "-- `wave` goes to one side, twice to the other, and back: from there the tip moves along lines in every "
         "direction\n"
         "-- (docs/how-to/bring-your-own-arm.md).\n"
         "for k = 1, 2 * kSegments do\n"
         "  local m = (k + 1) // 2\n" +
         filled("  zero[k], bent[k], back[k] = 0, %.3g * (k %% 2 == 0 and -1 or 1), %.3g * (k %% 3 == 0 and -1 or 1)\n",
                bent_deg, 0.75 * bent_deg) +
         filled("  wave[k] = %.3g * (m %% 4 < 2 and 1 or -1)\n",
                start_bend_deg({a.segments, a.modules, a.theta_limit_deg})) +
         "end\n\n";
}

// Sizes in proportion to an arm of 1.44 m with discs of 25 mm radius.
std::string body(const std::string& name, const Answers& a) {
  const double arm_m = a.segments * a.modules * a.length_m, size = a.radius_m / 0.025;
  const double plan_N = std::max(kMinPlan_N, kUsualPlan_N * size * size), drum_m = 0.012 * std::sqrt(size),
               hard_N = 15.0 * plan_N;
  const double mass_kg = std::max(0.00001, 0.2 * size * size * (a.length_m / 0.08)),
               reach = std::min(1.0, arm_m / 1.44);
  const double tip_m_deg = tip_way_m_deg({a.segments, a.modules, a.theta_limit_deg}, arm_m);
  const double theta_rate_deg_s = std::min(kThetaRate_deg_s, 0.1 * reach / tip_m_deg);
  const double theta_accel_deg_s2 = 2.0 * theta_rate_deg_s,
               speed_m_s = std::max(tip_m_deg * theta_rate_deg_s, kMinTipSpeed * arm_m);
  const double lead_m = std::clamp(0.2 * arm_m, kShortestLead_m, 10.0), shortest_m = a.modules * a.length_m + lead_m;
  const double EA_N =
      std::clamp(150000.0 * size * size, 1500.0, std::max(1500.0, plan_N * shortest_m / kPlanStretch_m));
  return filled("return {\n  format = 1, kind = \"robot\", name = \"%s\",\n  segments = segments,\n", name.c_str()) +
         filled("  module = { mass_kg = %.4g, radius_m = %g }, -- radius asked; weigh one\n", mass_kg, a.radius_m) +
         filled("  joint = { viscous_Nms_per_rad = %.3g },\n", 0.3 * size * size) + "  cables = {\n" +
         filled("    hole_radius_m = %.4g,\n    face_offset_m = %.4g, -- disc faces before and after a joint centre\n",
                kHoleShare * a.radius_m, 0.1 * a.length_m) +
         filled("    phase_deg = phase_deg,\n    EA_N = %.4g, -- stiffness of the rope: modulus times area\n", EA_N) +
         filled("    lead_m = %.3g, -- free cable between drum and first disc\n", lead_m) +
         "    friction_mu = { nominal = 0.05, ideal = 0, worn = 0.10 }, -- of a cable in its holes; `liana calibrate "
         "--friction`\n" +
         filled("    monitor = { jump_N = %.3g }, -- tension that comes or goes at once, and is a fault\n",
                std::max(kUsualJump_N, kUsualJump_N * plan_N / kUsualPlan_N)) +
         "  },\n" +
         filled(
             "  tension = { plan_N = %.3g, floor_motor_N = %.3g, floor_anywhere_N = %.3g, ceiling_free_N = %.3g, "
             "alarm_N = %.3g, hard_limit_N = %.3g },\n",
             plan_N, plan_N / 3.0, plan_N / 30.0, 5.0 * plan_N, 10.0 * plan_N, hard_N) +
         "  drives = {\n" +
         filled("    drum_radius_m = %.4g,\n    counts_per_turn = 65536,\n    gear = 1, -- motor turns per drum turn\n",
                drum_m) +
         filled(
             "    servo_time_constant_s = 0.03,\n    rated_torque_Nm = %.3g, -- at the drum: what the hard limit "
             "needs\n",
             1.05 * hard_N * drum_m) +
         "    identity = { vendor = 0x4C49, product = 1, revision = 1 }, -- object 0x1018 of your drives\n"
         "    direction = direction,\n    zero_counts = zero_counts,\n  },\n" +
         filled(
             "  limits = { -- slow, as for a first motion\n    theta_rate_deg_s = %.3g,\n    theta_accel_deg_s2 = "
             "%.3g,\n",
             theta_rate_deg_s, theta_accel_deg_s2) +
         filled(
             "    tip_speed_m_s = %.3g, -- and acceleration: what these angles can give in every direction from "
             "`wave`\n"
             "    tip_speed_slit_m_s = %.3g,\n    tip_accel_m_s2 = %.3g,\n",
             speed_m_s, 0.3 * speed_m_s,
             std::min(0.15 * reach, std::max(speed_m_s, kShareOfAccel * tip_m_deg * theta_accel_deg_s2))) +
         "    tip_jerk_m_s3 = 1,\n    tip_rate_deg_s = 20,\n    tip_angular_accel_deg_s2 = 40,\n"
         "    tip_angular_jerk_deg_s3 = 400,\n    cable_speed_m_s = 0.010,\n  },\n"
         "  named_poses_deg = { zero = zero, bent = bent, back = back, wave = wave },\n"
         "  start_pose = \"wave\",\n"
         "  -- jig_poses = { \"zero\", \"bent\", \"back\" }, -- where you have jigs, for `liana "
         "calibrate`\n}\n";
}

}  // namespace

std::string about(const NumberQuestion& asked) {
  return filled("%s, %g to %g %s", asked.question, asked.least, asked.most, asked.unit);
}

std::string about(const WholeQuestion& asked) {
  return filled("%s, %d to %d", asked.question, asked.least, asked.most);
}

int robot_new_command(const RobotNewOptions& options) {
  const bool is_name = !options.name.empty() && options.name.size() <= 40 &&
                       options.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!is_name)
    throw launcher::BadInput("robot new: name: '" + options.name +
                             "': allowed 1 to 40 small letters, digits and _; choose another");
  const std::string file = options.file.empty() ? options.name + ".lua" : options.file;
  if (access(file.c_str(), F_OK) == 0)
    throw launcher::BadInput("robot new: " + file + ": exists already; give another --out, or move it away");
  launcher::check_output("--out", file);
  const Answers answers = ask(options);
  launcher::write_output(file, head(options.name, answers) + body(options.name, answers));
  std::printf("%s\nnext: liana robot check %s\n", file.c_str(), file.c_str());
  return launcher::kExitOk;
}

}  // namespace liana::cli
