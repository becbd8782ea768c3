// What the page "try it" calls of the arm: as WebAssembly in a browser, and compiled natively in the test that compares
// both. Texts are passed through one place.
#pragma once

#include <cstdint>

#ifdef __wasm__
#define LIANA_EXPORT(name) [[clang::export_name(name)]]
#else
#define LIANA_EXPORT(name)
#endif

extern "C" {

// Where `bytes` bytes may be written, until the next call of any function here.
LIANA_EXPORT("room") char* liana_try_room(std::uint32_t bytes);

// Begins anew with the tables in the room, canonical JSON: buses, robot, scene, a line each. The arm stands at the
// robot's pose `panel_edge`, is homed, and has no power. Tables that the loader refuses end the program: they are part
// of the page.
LIANA_EXPORT("begin") void liana_try_begin();

// One command interval of 20 ms. `request`: a liana::Request; `wanted`: 1: the tip should go to x y z [m], attitude
// qw qx qy qz (unit quaternion), base frame; 0: the arm comes to rest.
LIANA_EXPORT("interval")
void liana_try_interval(std::uint32_t request, std::uint32_t wanted, double x, double y, double z, double qw, double qx,
                        double qy, double qz);

// The state as JSON, and the hash of all that is remembered (64 hex digits): into the room; returns how many bytes.
LIANA_EXPORT("state") std::uint32_t liana_try_state();
LIANA_EXPORT("hash") std::uint32_t liana_try_hash();

// Where the room is.
LIANA_EXPORT("place") const char* liana_try_place();
}
