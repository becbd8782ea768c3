// An arm that has lost a cable: what keeps its fault, and what leads it out. The core goes back along the verified path
// without that cable (firmware_like/cable/arm/let_go.hpp); here stands who may ask for it, and what speaks against it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/let_go.hpp"
#include "firmware_like/cable_controller.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/control/arbiter/path_history.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::server {

// A tick of the arm as recovery sees it. References live as long as the caller's.
struct LossView {
  const cable::RobotParams& table;
  const cable::Outputs& outputs;
  const cable::SegmentReleaseState& release;  // of the core
  const config::DriveNames& names;
};

// Cables that a latched fault 5006 names, or that the arm does without; 0-based, ascending.
std::vector<std::size_t> lost_cables(const LossView& arm);

// Empty when every lost cable takes tension; else which one does not, with its newtons and the way on.
std::string why_loss_stands(const LossView& arm);

// Empty when the arm can go back without what it has lost; else why not: which cable, newtons, where on the path.
std::string why_not_recover(const LossView& arm, const arbiter::PathHistory<cable::ThetaVector>& path);

// `recovery` of the state: null when no cable is lost.
Json recovery_json(const LossView& arm, const arbiter::PathHistory<cable::ThetaVector>& path);

// Cables that keep an arm from being enabled, with their newtons; empty: none.
std::string slack_cables(const LossView& arm);

// An arm that goes back without a cable holds when another one is pulled harder than this: something is in its way.
inline double max_recovery_N(const cable::RobotParams& table) { return table.tension.ceiling_free_N; }
// The first cable over that, in words; empty: none, or the arm has lost no cable.
std::string overpulled_cable(const LossView& arm);

}  // namespace liana::server
