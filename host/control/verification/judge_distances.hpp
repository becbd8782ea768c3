// The second end's first question, for every kind of arm: does the simulated motion keep off the scene and off itself.
#pragma once

#include <functional>
#include <string>

#include "host/control/verification/verdict.hpp"
#include "host/model/simulation/motion.hpp"

namespace liana::verification {

// What the bound between poses and the noise of a measured pose may give away.
constexpr double kGivenAway_m = 1e-3;

// Of what the arm moves, an arm that has crept nearer has to go away from the scene.
constexpr double kAwayShare = 0.1;

// How much nearer it may come before it is away, and than it stands after a refusal. An offset from the command settles
// in the simulation and stays in truth: 0.3 mm at the end of a motion look like away.
constexpr double kCreptDip_m = 1e-4;

// By how much less than the farthest it has stood off an arm may be led at all, and go along in a retract after any
// number of refusals.
constexpr double kMostCrept_m = 3e-3;

// What a stop after a refusal takes more than simulated.
constexpr double kStopBeyond_m = 3e-3;

// How much farther off than it has to be an arm is where what it came nearer by is forgotten.
constexpr double kLeft_m = 3e-3;

// How near to something an arm may be led that is nearer to it than commands may leave it: 1 mm less than the farthest
// it has stood off since. Motions may lead it away, and along beside a body no nearer than that. What is no nearer as
// simulated may be nearer by the simulation's error, again and again: an arm that has come nearer than that only goes
// away, and one that has come nearer by kMostCrept_m only retracts. A retract may go along once more from where a
// refusal has left it, so that a way back is there.
class TooNearTo {
 public:
  // The next motion begins so far off.
  void stand(double distance_m);
  // It is far enough off, or something else than commands has led it away.
  void forget() { *this = {}; }
  void refused() { was_refused_ = true; }
  // The arm was disabled, which may have moved it: a retract may go along from where it stands then.
  void disabled() { was_disabled_ = true; }
  bool stands() const { return stands_; }
  // No motion may end nearer than that.
  double least_m(bool retracts) const { return retracts ? back_m_ : min_m_; }
  // It may go away from where it stands.
  bool may_be_led(double distance_m) const { return distance_m >= farthest_m_ - kMostCrept_m; }

 private:
  double farthest_m_ = 0.0, min_m_ = 0.0, back_m_ = 0.0;
  bool stands_ = false, was_refused_ = false, was_disabled_ = false;
};

struct TooNear {
  TooNearTo scene, itself;
  bool retracts = false;  // the motion that is judged next
  void forget() { *this = {}; }
  // To itself an arm may stay as near as it is enabled.
  void disabled() {
    scene.disabled();
    itself.forget();
  }
};

// What people call link 0, 1, ...
using LinkName = std::function<std::string(std::int32_t)>;

// "link 3" for 2.
std::string plain_link_name(std::int32_t link);

// Refuses contact with the scene (208) and with itself (209); sets `slowly`, margins.clearance_m and where the arm
// comes nearest. `travel_m`: the farthest that any point of the arm is moved. `too_near`: of all motions of this arm in
// turn.
void judge_distances(const config::SceneConfig& scene, const simulation::Distances& distances,
                     const LinkName& link_name, double travel_m, TooNear& too_near, SimulationVerdict& verdict);

// Of what is refused: why, and what comes first.
void refuse(SimulationVerdict& verdict, Refusal code, const std::string& text, const First& first);

std::string in_millimetres(double distance_m);

}  // namespace liana::verification
