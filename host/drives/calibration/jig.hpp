// The arm in a fixture, at a pose whose angles are known: what its drives have to report there, and what that says
// about their cables (docs/how-to/calibrate.md).
#pragma once

#include <string>

#include "host/model/config/config.hpp"

namespace liana::calibration {

// Most that a cable may differ from what a pose says [m]: a fixture that is right to 0.05 degrees at every angle is
// within it.
constexpr double kFixtureTolerance_m = 3e-3;

// A named pose of the robot's table. Throws std::runtime_error "pose 'name': allowed are the named poses ..." when
// there is none.
cable::ThetaVector named_pose_rad(const config::RobotConfig& robot, const std::string& name);

// Unstretched cable that every drive has paid out beyond its zero with the arm at one pose and each cable pulled with
// `tension_N` [m].
cable::CableVector beyond_zero_m(const cable::RobotParams& table, const cable::ThetaVector& theta_rad,
                                 const cable::CableVector& tension_N);

// The named pose tells every two cables apart by three times the tolerance, so that no two drives can have each other's
// cable unnoticed; throws std::runtime_error naming two cables that it does not.
void check_tells_apart(const config::RobotConfig& robot, const std::string& name);

// What contradicts that the arm lies in the named pose: drives that are off by more than the tolerance, the farthest
// three named, and two that read what the other one should. Empty: nothing does. `paid_out_m`: reported by every drive,
// beyond its zero.
std::string contradiction(const config::RobotConfig& robot, const std::string& name,
                          const cable::CableVector& paid_out_m, const cable::CableVector& tension_N);

// "one turn", "2 turns" where a drive is off by whole turns of its motor's encoder, to a jig's tolerance; else empty.
// An encoder that counts its turns only with power loses them so.
std::string whole_turns(const config::RobotConfig& robot, std::size_t drive, double off_m);

}  // namespace liana::calibration
