// The dual active-set method of Goldfarb and Idnani (Math. Program. 27, 1983) for a point and bounds on the thetas, in
// B lanes of four coordinates: which bounds hold the point back, and with what force. For bounds.cpp alone.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "firmware_like/cable/shape/bounds.hpp"
#include "firmware_like/cable/shape/lanes.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {

// Coordinates in which the metric of a problem is the distance: theta k is axis[k] . y, within bounds.
template <std::size_t B>
struct Frame {
  std::array<Lanes<B>, kMaxTheta> axis;
  std::size_t thetas;
  const ThetaBounds* bounds;

  double bound(std::size_t theta, double side) const noexcept {
    return side > 0.0 ? bounds->high[theta] : -bounds->low[theta];
  }
};

// One bound that holds y back, and its force.
struct Active {
  std::size_t theta;
  double side, force;
};

// All of them in the order in which they came, at most one per dimension: normals q r with orthonormal q and triangular
// r.
template <std::size_t B>
struct ActiveSet {
  std::array<Active, 4 * B> bound;
  std::array<Lanes<B>, 4 * B> q;
  std::array<std::array<double, 4 * B>, 4 * B + 1>
      r;  // r[i]: column of bound i; the last one is of a bound that is yet to come
  std::size_t count = 0;
};

inline constexpr double kMinReply = 1e-12;  // below this a bound depends on those before it

// The normal of one more bound: its parts along those before it are put into their column, `rest` is what remains.
template <std::size_t B>
struct Normal {
  Lanes<B> rest;
  double length2, rest2;
  bool is_new() const noexcept { return rest2 > kMinReply * length2; }
};

template <std::size_t B>
inline Normal<B> normal_of(const Frame<B>& frame, const Active& bound, std::size_t i, ActiveSet<B>& active) noexcept {
  Normal<B> out;
  out.rest = scaled(bound.side, frame.axis[bound.theta]);
  out.length2 = product(out.rest, out.rest);
  for (std::size_t j = 0; j < i; ++j) {
    const double part = product(active.q[j], out.rest);
    active.r[i][j] = part;
    add_scaled(-part, active.q[j], out.rest);
  }
  out.rest2 = product(out.rest, out.rest);
  return out;
}

template <std::size_t B>
inline void append(const Active& bound, const Normal<B>& normal, ActiveSet<B>& active) noexcept {
  const std::size_t i = active.count++;
  const double length = std::sqrt(normal.rest2);
  active.bound[i] = bound;
  active.r[i][i] = length;
  active.q[i] = scaled(1.0 / length, normal.rest);
}

// Leaves out one bound; those after it are taken up again.
template <std::size_t B>
void release(const Frame<B>& frame, std::size_t released, ActiveSet<B>& active) noexcept {
  const std::size_t count = active.count;
  active.count = released;
  for (std::size_t i = released + 1; i < count; ++i) {
    const Active bound = active.bound[i];
    append(bound, normal_of(frame, bound, active.count, active), active);
  }
}

enum class Pressed { kMet, kReleased, kContradicted };

// Raises the force of one more bound until it is met, and then active, or until an active force has fallen to zero.
template <std::size_t B>
Pressed press(const Frame<B>& frame, Active& added, ActiveSet<B>& active, Lanes<B>& y) noexcept {
  const std::size_t count = active.count;
  const Normal<B> normal = normal_of(frame, added, count, active);
  const bool moves = count < 4 * B && normal.is_new();
  const double beyond = added.side * product(frame.axis[added.theta], y) - frame.bound(added.theta, added.side);
  double more = moves ? beyond / normal.rest2 : 1e300;
  std::array<double, 4 * B> yield;  // how active forces give way, so that their bounds stay met
  std::size_t released = count;
  for (std::size_t i = count; i-- > 0;) {
    double left = active.r[count][i];
    for (std::size_t j = i + 1; j < count; ++j) left -= active.r[j][i] * yield[j];
    yield[i] = left / active.r[i][i];
    if (yield[i] > 0.0 && active.bound[i].force < more * yield[i])
      more = active.bound[i].force / yield[i], released = i;
  }
  if (!moves && released == count) return Pressed::kContradicted;
  for (std::size_t i = 0; i < count; ++i) active.bound[i].force -= more * yield[i];
  added.force += more;
  if (moves) add_scaled(-more, normal.rest, y);
  if (released < count) {
    release(frame, released, active);
    return Pressed::kReleased;
  }
  append(added, normal, active);
  return Pressed::kMet;
}

// Takes up bounds as equalities, those that depend on others left out.
template <std::size_t B>
void recall(const Frame<B>& frame, const HeldBounds& held, ActiveSet<B>& active) noexcept {
  active.count = 0;
  const std::uint32_t any = held.low | held.high;
  for (std::size_t k = 0; k < frame.thetas && active.count < 4 * B; ++k) {
    if (((any >> k) & 1u) == 0) continue;
    const Active bound{k, ((held.high >> k) & 1u) != 0 ? 1.0 : -1.0, 0.0};
    const Normal<B> normal = normal_of(frame, bound, active.count, active);
    if (normal.is_new()) append(bound, normal, active);
  }
}

// Moves y to where all active bounds are met as equalities; returns the least of the forces that this takes, or 0.
template <std::size_t B>
double press_all(const Frame<B>& frame, ActiveSet<B>& active, Lanes<B>& y) noexcept {
  std::array<double, 4 * B> along;
  const Lanes<B> free = y;
  for (std::size_t i = 0; i < active.count; ++i) {
    const Active& bound = active.bound[i];
    double left = bound.side * product(frame.axis[bound.theta], free) - frame.bound(bound.theta, bound.side);
    for (std::size_t j = 0; j < i; ++j) left -= active.r[i][j] * along[j];
    along[i] = left / active.r[i][i];
    add_scaled(-along[i], active.q[i], y);
  }
  double least = 0.0;
  for (std::size_t i = active.count; i-- > 0;) {
    double left = along[i];
    for (std::size_t j = i + 1; j < active.count; ++j) left -= active.r[j][i] * active.bound[j].force;
    active.bound[i].force = left / active.r[i][i];
    least = smaller(least, active.bound[i].force);
  }
  return least;
}

// Bounds that push, or all.
template <std::size_t B>
HeldBounds held_by(const ActiveSet<B>& active, bool only_pushing) noexcept {
  HeldBounds held;
  for (std::size_t i = 0; i < active.count; ++i) {
    if (only_pushing && active.bound[i].force < 0.0) continue;
    (active.bound[i].side > 0.0 ? held.high : held.low) |= 1u << active.bound[i].theta;
  }
  return held;
}

// Begins with the bounds that were held last, but for those that would have to pull.
template <std::size_t B>
void begin_with(const Frame<B>& frame, const HeldBounds& held, ActiveSet<B>& active, Lanes<B>& y) noexcept {
  const Lanes<B> free = y;
  recall(frame, held, active);
  if (press_all(frame, active, y) >= 0.0) return;
  y = free;
  recall(frame, held_by(active, true), active);
  if (press_all(frame, active, y) >= 0.0) return;
  y = free;
  active.count = 0;
}

}  // namespace liana::cable
