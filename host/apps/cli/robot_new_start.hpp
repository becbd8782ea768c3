// Where the arm of a table that `liana robot new` writes begins, and how fast its tip may go from there.
//
// The start pose bends every segment by the same angle about both axes, the first to one side, two to the other, two
// back: + - - + + - - +. The middle of the arm then stands off the line from base to tip, and swings around it while
// the tip keeps its place: so the tip rolls about its own axis, which no universal joint does by itself. An arm that is
// straight or a spiral (all segments to one side, or by turns) rolls only to the second order: every line of the tip
// that keeps its attitude asks more of the angles than they can give.
#pragma once

namespace liana::cli {

struct StartOf {
  int segments = 0, modules = 0;  // modules of each segment
  double theta_limit_deg = 0.0;
};

// Of each angle, its size in the start pose [deg]: at most half the limit, 60 deg for a segment and 300 deg for the
// arm, because every bend costs tension.
double start_bend_deg(const StartOf& arm);

// How far the tip of an arm `arm_m` long goes from there in any direction, its attitude kept, while no angle turns by
// more than one degree [m/deg]. For 3 segments or more.
double tip_way_m_deg(const StartOf& arm, double arm_m);

}  // namespace liana::cli
