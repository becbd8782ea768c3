// The simulated person at the VR handles: every number that shapes how they see, decide and move.
#pragma once

#include "host/operator/simulated/hand_gains.hpp"

namespace liana::simulated {

// Defaults are a calm, practised operator. Positions at the arm unless the name says hand.
struct VrGains {
  // Seeing
  double reaction_s = 0.15;  // from a picture to the hands
  double look_s = 0.8;       // looks this long before gripping
  double blind_s = 1.0;      // without a picture for this long, the hands stop

  // Deciding, by imagining how the drawn arm moves along (hands_plan.hpp)
  double comfortable_m = 0.45;  // more room than this between arm and bodies is worth no detour
  double worry_m = 0.12;        // imagined to come nearer than this in a moment: stop and decide anew
  double moment_m = 0.15;       // of way
  double trail = 0.85;          // the arm from the left hand's node to the tip is pulled as straight as this
  double tilt_rad = 0.25;       // the node is led behind the tip, or at most so far beside that
  double detour_m = 0.40;       // by this, or half of it, both hands go round what is in the way
  double way_price = 0.02;      // room that a metre of way more has to be worth

  // Where "the panel's edge" is: before the slit's mouth, on the panel's side, in the slit frame (x into the slit from
  // the mouth, y across, z along the mouth); heading into the slit
  double before_mouth_m = 1.50;
  double off_plane_m = 0.45;
  double along_mouth_m = 0.54;
  double turn_share = 0.75;  // of the turn towards the slit; the rest is for the hand controller, which is finer

  // Moving
  double speed_m_s = 0.060;       // of the tip
  double node_speed_m_s = 0.075;  // of the node
  double turn_rate_rad_s = 0.09;  // 5 deg/s
  double accel_m_s2 = 0.04;
  double wait_from_m = 0.09;  // the tip is seen to be behind by this: go slower
  double wait_full_m = 0.20;  // by this: wait for it

  // Hands
  double hand_reach_m = 0.50;      // from where an arm is comfortable; re-indexes from here on
  double hand_reach_rad = 1.0;     // and from this turn of the wrist on
  double return_speed_m_s = 0.80;  // peak, with the triggers released
  double grip_s = 0.20;            // keeps still after gripping
  double settle_s = 0.60;          // keeps still before letting go
  double arm_stops_s = 1.2;        // after letting go, before what is seen counts as the arm at rest
  double patience_s = 0.6;         // triggers held, arm not following: let go and grip again
  double tremor_m = 0.0002;        // RMS of each axis
  double tremor_rad = 0.0005;      // RMS of each axis

  // When it is good enough
  double there_m = 0.03;
  double there_rad = 0.06;
  double there_dwell_s = 0.5;
};

}  // namespace liana::simulated
