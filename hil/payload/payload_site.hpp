// Where the payload is and what it meets: the transfer mechanism that holds it first, the arm's end effector, the
// adapter. Everything in the root's frame of the arm (hil/serial/flexible_chain.hpp), unless a name says otherwise.
#pragma once

#include <cstdint>

#include "hil/config/payload_config.hpp"
#include "hil/serial/adapter.hpp"
#include "hil/serial/tip_state.hpp"

namespace liana::bench {

enum class Holder : std::uint8_t { kMechanism = 0, kArm = 1, kAdapter = 2 };

// A body as it is in another frame, in which its own frame is `pose`.
BodyConfig moved_body(const Pose& pose, const BodyConfig& body);

class PayloadSite {
 public:
  // What the grapple of a held payload is to a tip that presses on it, until it closes; assumed.
  static constexpr double kGrappleStiffness_N_m = 2e4;
  static constexpr double kGrappleDamping_Ns_m = 400.0;
  static constexpr double kGrappleRadius_m = 0.1;  // beside it there is nothing

  // `payload.pose` and `socket` in the root's frame; a payload on the arm lies exactly on the tip.
  PayloadSite(const PayloadConfig& payload, const Pose& socket, const AdapterParams& figures);

  // What is met, on the tip about its origin.
  TipLoad push(const TipState& tip) const;
  // What the adapter does to the payload on the arm, about the plate's origin, in the socket's frame.
  TipLoad adapter_load(const TipState& tip) const;
  // Adapter's sensors, latch and lock drive, once per physics step.
  void step(double step_s, const TipState& tip);

  // The arm takes the payload just where it is; what the body is in the tip's frame from now on.
  BodyConfig take(const Pose& tip);
  // The arm lets go of it; it stays where it is.
  void let_go(const Pose& tip);

  Holder holder() const { return holder_; }
  // Of the payload now: with it on the arm it goes with the tip.
  Pose payload(const Pose& tip) const;
  // Of the pins' plane, and the same in the socket's frame.
  Pose plate(const Pose& tip) const;
  Pose plate_in_socket(const Pose& tip) const { return relative(socket_, plate(tip)); }
  const Pose& socket() const { return socket_; }
  Adapter& adapter() { return adapter_; }
  const Adapter& adapter() const { return adapter_; }
  // Mechanism and adapter move against the root.
  void shift(const Vec3& by_m);

 private:
  TipState plate_state(const TipState& tip) const;  // in the socket's frame
  TipLoad push_on_grapple(const TipState& tip) const;

  PayloadConfig payload_;
  Pose socket_;
  Adapter adapter_;
  Holder holder_;
  Pose held_at_;  // where mechanism or adapter hold it
  Pose grip_;     // of the payload in the tip's frame, while the arm has it
};

}  // namespace liana::bench
