// The simulated person at the hand controller: every number that shapes how they see, decide and move.
#pragma once

namespace liana::simulated {

// Defaults are a calm, practised operator. Positions at the arm's tip unless the name says hand.
struct HandGains {
  // Seeing
  double reaction_s = 0.15;        // from a picture to the hand
  double camera_latency_s = 0.10;  // age of a picture, known from practice
  double expected_lag_s = 0.36;    // first-order lag of the arm behind the hand, known from practice
  double look_s = 0.6;             // looks this long before gripping
  double blind_s = 1.0;            // without a picture for this long, the hand stops
  double judge_tau_s = 0.8;        // low pass of the error that decides "there"

  // Correcting: a slow integral of what is seen against what the hand should have done; the arm is soft, fast
  // corrections make it swing
  double correction_per_s = 0.25;        // 0.1..0.3
  double correction_speed_m_s = 0.010;   // most
  double correction_rate_rad_s = 0.010;  // most
  double along_quiet_s =
      1.5;                    // while moving and this long after, errors along the motion are lag and are not corrected
  double wait_from_m = 0.06;  // the arm falls behind by this: go slower
  double wait_full_m = 0.14;  // by this: wait for it

  // Moving
  double free_speed_m_s = 0.075;
  double slit_speed_m_s = 0.0252;
  double turn_rate_rad_s = 0.09;  // 5 deg/s
  double accel_m_s2 = 0.02;       // of the intended motion: braked harder, a soft arm swings for long

  // Hand
  double workspace_m = 0.070;      // radius the device can reach
  double reach_m = 0.062;          // the person re-indexes from here on
  double reach_rad = 0.80;         // and from this turn of the wrist on
  double return_speed_m_s = 0.25;  // peak, with the button released
  double settle_s = 0.5;           // keeps still before letting go, so that nothing is lost on re-indexing
  double settled_m = 0.012;        // as long as the arm is further behind than this it is waited for before letting go,
  double settle_most_s = 3.0;      // but not for longer: letting go stops it wherever it is
  double grip_s = 0.20;            // keeps still after gripping
  double arm_stops_s = 0.45;       // after letting go, before what is seen counts as the arm at rest
  double patience_s = 0.6;         // button held, arm not following: let go and grip again
  double tremor_m = 0.0001;        // RMS of each axis, at the hand
  double tremor_rad = 0.0005;      // RMS of each axis, at the hand

  // Where to go, in the slit frame (x into the slit from the mouth, y across, z along the mouth)
  double approach_before_mouth_m = 0.40;  // aligned here before going in
  double approach_z_m = 0.50;
  double slow_before_mouth_m = 0.10;  // slit speed from here on: the swing of slowing down dies away before the mouth
  double switch_depth_m = 1.37;       // a little past the depth at which segment 4 goes planar (u = 3.10 m)
  double switch_z_m = 0.36;

  // When it is good enough
  double align_m = 0.0025;
  double align_rad = 0.0030;
  double align_dwell_s = 0.6;
  double depth_m = 0.005;  // at the switch depth; along the slit it does not matter
  double fine_m = 0.0011;
  double fine_rad = 0.0015;  // 0.09 deg
  double fine_dwell_s = 2.0;
  double relent_s = 40.0;  // after striving this long at a goal, a little more error will do: friction lets a soft arm
                           // creep for minutes
  double relent_most = 1.15;        // times the tolerances above, at most
  double align_relent_most = 1.15;  // the same before the mouth, where going in corrects it further
  // Who has striven there for this long gives in, by as much again in the same time, up to align_at_last: a worn arm
  // may never stand still enough, and what lively people go in with (temper.hpp) is good enough.
  double give_in_s = 60.0;
  double align_at_last = 2.15;
};

}  // namespace liana::simulated
