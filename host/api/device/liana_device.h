/* The device protocol of lianad, for drivers in any language (docs/reference/device-protocol.md). C99, nothing but
   <stdint.h>.
 *
 * A driver is a process: it connects to the socket of devices (AF_UNIX, SOCK_SEQPACKET; `lianad --devices PATH`, by
 * default the path of the API socket with ".devices" behind it), sends liana_hello, and from then on a liana_sample per
 * hand at the device's own rate. lianad answers with liana_welcome and then sends a liana_state every command interval.
 * One packet is one struct below, whole; all of them are little-endian and naturally aligned, and begin with
 * liana_header.
 *
 * Units are SI. Poses are of the hand, or of the tip, in the device frame, which is parallel to the arm's base frame.
 * Every number is finite and none is denormal; quaternions have length 1 within 1e-6. Times "_us" are of the device's
 * own clock, microseconds that only grow, unless they are called arm time.
 */
#ifndef LIANA_DEVICE_H
#define LIANA_DEVICE_H

#include <stdint.h>

#define LIANA_MAGIC 0x4e41494cu /* "LIAN" */
#define LIANA_VERSION 1
#define LIANA_NAME_BYTES 32
#define LIANA_MAX_HANDS 2
#define LIANA_MAX_PLANES 6

/* header.packet */
enum liana_packet {
  LIANA_HELLO = 1,   /* up, first: what the device is */
  LIANA_SAMPLE = 2,  /* up: a hand */
  LIANA_BYE = 3,     /* up, last: only the header; leaving without it is the same to the arm */
  LIANA_WELCOME = 4, /* down: answers hello */
  LIANA_REFUSED = 5, /* down: why, then the connection ends */
  LIANA_STATE = 6    /* down, every command interval */
};

struct liana_header {
  uint32_t magic;    /* LIANA_MAGIC */
  uint16_t version;  /* LIANA_VERSION */
  uint16_t packet;   /* enum liana_packet */
  uint32_t bytes;    /* of the whole packet, this header included */
  uint32_t sequence; /* 1, 2, ... of samples, and of states; 0 in the others */
};

/* A rigid pose: position, unit quaternion (w, x, y, z). */
struct liana_pose {
  double position_m[3];
  double quaternion_wxyz[4];
};

struct liana_twist {
  double linear_m_s[3];
  double angular_rad_s[3];
};

struct liana_wrench {
  double force_N[3];
  double torque_Nm[3];
};

/* ---- up ---- */

/* hello.kind: what `use_device` calls it */
enum liana_device_kind {
  LIANA_HAND_CONTROLLER = 1, /* "hand": a desktop device, with or without force */
  LIANA_HANDLES = 2,         /* "vr": one or two tracked handles in free space */
  LIANA_POINTER = 3          /* "pointer": SpaceMouse, gamepad; its driver integrates a pose */
};

/* sets of axes in liana_hand, of position, of attitude, and whether the twist is told */
enum liana_axes {
  LIANA_X = 1,
  LIANA_Y = 2,
  LIANA_Z = 4,
  LIANA_ABOUT_X = 8,
  LIANA_ABOUT_Y = 16,
  LIANA_ABOUT_Z = 32,
  LIANA_TWIST = 64, /* sensed only: measured_cv is measured */
  LIANA_ALL_AXES = 63
};

/* What one hand of the device can. */
struct liana_hand {
  uint32_t sensed;                     /* axes that it measures */
  uint32_t actuated;                   /* axes in which it can push */
  uint32_t buttons;                    /* how many, besides deadman and trigger: 0 to 32 */
  uint32_t reserved;                   /* 0 */
  double low_m[3], high_m[3];          /* workspace, a box: low <= high, within 10 m */
  double max_force_N, max_torque_Nm; /* 0: none; at most 1000 */
};

struct liana_hello {
  struct liana_header header;
  char name[LIANA_NAME_BYTES]; /* 1 to 31 of a-z A-Z 0-9 _ - . and zeros behind; no two devices have the same */
  uint32_t kind;               /* enum liana_device_kind */
  uint32_t hands;              /* 1 or 2; hand 0 moves the tip, hand 1 a node of the arm */
  int64_t t_us;                /* now */
  double rate_hz;              /* of samples of each hand: 1 to 4000; below 50 an alarm tells */
  double watchdog_s;           /* so long after the newest state it still renders force: 0 to 1 */
  struct liana_hand hand[LIANA_MAX_HANDS];
};

enum liana_sample_flags {
  LIANA_VALID = 1,  /* the hand is tracked; otherwise the pose is the last one known */
  LIANA_DEADMAN = 2, /* held: the arm follows */
  LIANA_STALE = 4   /* the device has told its driver nothing new: the arm is let go, and follows after LIANA_DEADMAN
                       was not held in a sample without this */
};

struct liana_sample {
  struct liana_header header;
  int64_t t_us;                   /* when it was measured; a driver that repeats old numbers says LIANA_STALE */
  uint32_t hand;                  /* 0 or 1 */
  uint32_t flags;                 /* enum liana_sample_flags */
  uint32_t buttons;               /* bit i: button i is pressed */
  uint32_t echo_sequence;         /* of the newest state that has come; 0: none yet, or not told */
  int64_t echo_us;                /* when that came */
  double trigger;                 /* 0 open to 1 closed; 0 where there is none */
  struct liana_pose measured_cp;  /* of the hand */
  struct liana_twist measured_cv; /* zeros where it is not sensed */
};

struct liana_bye {
  struct liana_header header;
};

/* ---- down ---- */

struct liana_welcome {
  struct liana_header header;
  int64_t arm_time_us;   /* when it was sent */
  int64_t answers_us;    /* t_us of the hello: with the time at which this comes, the relation of the clocks */
  double interval_s;     /* T_c, from state to state */
  double silence_s;      /* a device in use that sends no sample for so long has let the arm hold */
  double min_rate_hz;  /* samples below this are an alarm */
  double tip_speed_m_s;  /* fastest that the tip follows */
  uint32_t max_samples; /* of the device in one command interval; more close it */
  uint32_t reserved;
};

struct liana_refused {
  struct liana_header header;
  char text[240]; /* what was wrong, what is allowed; zeros behind */
};

enum liana_state_flags {
  LIANA_ENABLED = 1, /* the arm is */
  LIANA_IN_USE = 2,  /* this device steers: use_device has named it */
  LIANA_ENGAGED = 4  /* the tip follows hand 0 now */
};

/* which parts of the state are told; those that are not are zeros and no pose */
enum liana_present {
  LIANA_HAS_MEASURED = 1,
  LIANA_HAS_SETPOINT = 2,
  LIANA_HAS_PREDICTED = 4,
  LIANA_HAS_FORCE = 8,      /* servo_cf */
  LIANA_HAS_REFERENCE = 16, /* reference_cp, stiffness, damping */
  LIANA_HAS_CLEARANCE = 32
};

/* A wall, to be rendered at the device's own rate: free where normal . p >= offset_m, p of the hand. */
struct liana_plane {
  double normal[3]; /* length 1, to the free side */
  double offset_m;
  double stiffness_N_m; /* 0 to 3000 */
  double damping_N_s_m; /* 0 to 30, when going in */
};

/* A driver that has had no state for `watchdog_s` renders no force, whatever the last one said. */
struct liana_state {
  struct liana_header header;
  uint64_t tick;
  int64_t arm_time_us; /* when it was sent */
  int64_t answers_us;  /* t_us of the newest sample that the command in force was made of; < 0: none */
  int64_t held_us;     /* how long that command has been in force */
  uint32_t flags;      /* enum liana_state_flags */
  uint32_t present;    /* enum liana_present */
  uint32_t planes;     /* how many of plane[] there are: 0 to LIANA_MAX_PLANES */
  uint32_t reserved;
  char reason[LIANA_NAME_BYTES]; /* why the arm does not follow any more; empty after letting go */
  double scale;                  /* way of the tip for a way of the hand */
  double rotation_scale;         /* turn of the tip for a turn of the hand */
  double watchdog_s;             /* after so long without another state there is to be no force */
  double clearance_m;            /* between the arm and what is nearest to it */
  struct liana_pose measured_cp; /* of the tip */
  struct liana_twist measured_cv;
  struct liana_pose setpoint_cp;       /* of the tip, commanded */
  struct liana_pose predicted_cp;      /* of the tip, at the end of the command released last */
  struct liana_wrench servo_cf;        /* for the hand to feel, before the device's own limits */
  struct liana_pose reference_cp;      /* where a spring pulls the hand to */
  double stiffness_N_m, damping_N_s_m; /* of that spring */
  struct liana_plane plane[LIANA_MAX_PLANES];
};

/* A compiler that lays a struct out otherwise fails here. */
#define LIANA_SIZE(name, bytes) typedef char liana_size_of_##name[sizeof(struct liana_##name) == (bytes) ? 1 : -1]
LIANA_SIZE(header, 16);
LIANA_SIZE(pose, 56);
LIANA_SIZE(twist, 48);
LIANA_SIZE(wrench, 48);
LIANA_SIZE(plane, 48);
LIANA_SIZE(hand, 80);
LIANA_SIZE(hello, 240);
LIANA_SIZE(sample, 160);
LIANA_SIZE(bye, 16);
LIANA_SIZE(welcome, 72);
LIANA_SIZE(refused, 256);
LIANA_SIZE(state, 752);
#undef LIANA_SIZE

#endif
