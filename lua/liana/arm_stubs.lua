---@meta
-- What `arm` offers to `run`, `finish` and conditions, annotated for editors. Never loaded; a test compares it with the registered commands.
-- Every command sends one request to lianad (docs/reference/api.md) and returns its id at once; a refusal fails the
-- step.

---@class Arm
---@field state table the last state message, docs/reference/api.md
---@field robot table the robot, docs/reference/formats.md
---@field scene table the scene, docs/reference/formats.md
---@field period_s number control period
---@field begin_tick integer tick at which the current step began
---@field was_engaged boolean the operator has engaged the device in this step
---@field must_hold table<integer, number> theta number -> degrees the current step holds
local arm = {}

-- ---- looking ----------------------------------------------------------------------------------------------------

---Angles (deg) of a named pose of the robot.
---@param name string
---@return number[]
function arm.named_pose(name) end

---The scene's slit or rod; raises when it has none.
---@param name string
---@return table
function arm.part_of_scene(name) end

---Measured tip position in the base frame [m].
---@return number[]
function arm.tip() end

---How far the tip is along the slit, measured from the base [m].
---@return number
function arm.slit_u() end

---Signed distance of the tip from the slit's middle plane [m].
---@return number
function arm.slit_offset() end

---Whether exactly the variables of this step are held.
---@return boolean
function arm.holds_what_it_should() end

---Time of the arm since a tick [s].
---@param since integer
---@return number
function arm.elapsed_s(since) end

---Plans a curve for the arm to follow; `liana.follow_curve` calls it. Raises what is wrong with the curve.
---@param request table from_deg, points {x, y, z} in the base frame [m], margin_m
---@return table plan waypoints_deg, tip_off_m, curve_off_m, curve_off_segment, curve_off_along_m
function arm.plan_curve(request) end

-- ---- commanding, made by ./dev docs ----

---@class arm.acquire
---owner that a client takes motion from: after an emergency stop, or 5 s without a sign of life of it
---@field from? string

---Own motion; one client at a time, and the death of the owner is a hold.
---@param fields? arm.acquire
---@return integer id
function arm.acquire(fields) end

---Give motion back; the arm holds.
---@return integer id
function arm.release() end

---@class arm.state_command
---what the arm should do; recover: clear, and go on without the cable of fault 5006: only retract moves then
---@field command "enable"|"disable"|"clear"|"home"|"recover"
---with clear: this cable of fault 5006 was looked at, and is whole
---@field whole? integer

---CRTK operating state.
---@param fields arm.state_command
---@return integer id
function arm.state_command(fields) end

---@class arm.move_jp
---angle that each joint or theta goes to
---@field goal_deg number[]
---the most that any angle may turn at (else the robot's fastest angle rate)
---@field rate_deg_s? number
---period with which the arm's base sways: the move takes longer and leaves it still; 0: as quickly as the
---limits let it (else 0)
---@field sway_s? number
---period of a second sway; 0: there is none (else 0)
---@field quicker_sway_s? number
---share by which `sway_s` may differ from the true period; over 0.1 takes longer (else 0.1)
---@field sway_tolerance? number
---grows from setpoint to setpoint of one owner: repeated and overtaken ones are refused
---@field sequence? integer
---the client's clock when it made the setpoint; never goes back (in virtual time: arm time)
---@field time_s? number
---time to live: with `time_s`, a setpoint that comes so much later than the quickest is refused
---@field ttl_s? number

---Joint goal, all angles together from rest to rest.
---@param fields arm.move_jp
---@return integer id
function arm.move_jp(fields) end

---@class arm.move_path
---points to go through; the first at most 1 deg from the command
---@field points_deg number[][]
---the most that any angle may turn at (else the robot's fastest angle rate)
---@field rate_deg_s? number
---clearance that the straight pieces between points have to have (else 0.001)
---@field margin_m? number
---grows from setpoint to setpoint of one owner: repeated and overtaken ones are refused
---@field sequence? integer
---the client's clock when it made the setpoint; never goes back (in virtual time: arm time)
---@field time_s? number
---time to live: with `time_s`, a setpoint that comes so much later than the quickest is refused
---@field ttl_s? number

---From rest through points on one time law, without a stop; looked at as a whole first.
---@param fields arm.move_path
---@return integer id
function arm.move_path(fields) end

---@class arm.move_cp.hold
---number of the angle, 1 at the base
---@field theta integer
---angle at which it is held
---@field target_deg number

---@class arm.move_cp
---pose that the tip goes to, in the base frame
---@field goal number[]
---as `held` of `hold_theta`, from the start of the line
---@field hold? arm.move_cp.hold[]
---period with which the arm's base sways: the move takes longer and leaves it still; 0: as quickly as the
---limits let it (else 0)
---@field sway_s? number
---period of a second sway; 0: there is none (else 0)
---@field quicker_sway_s? number
---share by which `sway_s` may differ from the true period; over 0.1 takes longer (else 0.1)
---@field sway_tolerance? number
---grows from setpoint to setpoint of one owner: repeated and overtaken ones are refused
---@field sequence? integer
---the client's clock when it made the setpoint; never goes back (in virtual time: arm time)
---@field time_s? number
---time to live: with `time_s`, a setpoint that comes so much later than the quickest is refused
---@field ttl_s? number

---Tip goal along a straight line at the tip limits.
---@param fields arm.move_cp
---@return integer id
function arm.move_cp(fields) end

---@class arm.servo_cp
---pose that the tip should have next, in the base frame
---@field goal number[]
---grows from setpoint to setpoint of one owner: repeated and overtaken ones are refused
---@field sequence? integer
---the client's clock when it made the setpoint; never goes back (in virtual time: arm time)
---@field time_s? number
---time to live: when no other follows in it the arm holds; with `time_s`, a setpoint that comes so much later
---than the quickest is refused
---@field ttl_s? number

---One of a stream of tip goals, at any rate; the newest of a command interval counts.
---@param fields arm.servo_cp
---@return integer id
function arm.servo_cp(fields) end

---@class arm.servo_target
---which of what the camera sees: its `target_name`, or `slit` or `rod`
---@field target string
---where the tip should be, or `point`, in the target's frame
---@field offset number[]
---what is led there, in the tip's frame: of what the arm holds; the tip itself when left out
---@field point? number[]
---of the target: the way in, along which `speed_m_s` counts; x when left out
---@field axis? "x"|"y"|"z"
---xi: so near along each of the target's axes (else 6e-04)
---@field tolerance_m? number
---xi: so near about each of the target's axes (else 0.4)
---@field tolerance_deg? number
---so long within the tolerances, then it ends by itself (else 1)
---@field dwell_s? number
---not there after this time it ends (else 120)
---@field timeout_s? number
---without a usable image for so long the target is lost (else 1)
---@field lost_s? number
---time constant of the low-pass on what the camera sees (else 4)
---@field tau_s? number
---period, roughly, with which the arm's base sways: the servo tells the sway from the target's place, and
---calms it; 0: the base stands still (else 0)
---@field sway_s? number
---period of a second sway; 0: there is none (else 0)
---@field quicker_sway_s? number
---share by which `sway_s` may differ from the true period; over 0.1 takes longer (else 0.1)
---@field sway_tolerance? number
---way of the tip against the slow sway, as a share of the sway: less for an arm that is heavy beside its
---base, 0: the sway is left as it is (else 1)
---@field calming? number
---k: speed for a way to go (else 0.45)
---@field gain_1_s? number
---fastest along the way in; the robot's own limit holds besides (else 0.028)
---@field speed_m_s? number
---fastest across it; the robot's own limit holds besides (else 0.008)
---@field lateral_speed_m_s? number
---fastest turn; the robot's own limit holds besides (else 0.5)
---@field rate_deg_s? number
---acceleration of the goal that is led (else 0.005)
---@field accel_m_s2? number
---the same of its turn (else 0.25)
---@field accel_deg_s2? number

---The tip goes to a place beside a target that the tip camera sees, stays there for the dwell, and the servo
---ends by itself.
---@param fields arm.servo_target
---@return integer id
function arm.servo_target(fields) end

---@class arm.hold_theta.held
---number of the angle, 1 at the base
---@field theta integer
---angle at which it is held
---@field target_deg number

---@class arm.hold_theta
---all that are held from now on; an empty list releases them
---@field held arm.hold_theta.held[]

---Held variables go to their targets at a bounded rate while the tip stays or follows. For cable arms only.
---@param fields arm.hold_theta
---@return integer id
function arm.hold_theta(fields) end

---@class arm.shape.nodes
---which, counted from the base; the tip has its own goal
---@field node integer
---where it should be, in the base frame
---@field position_m number[]
---1 for the arm's middle node and 0.25 for others when left out
---@field weight? number
---nearer than this nothing is done (else 0.01)
---@field threshold_m? number

---@class arm.shape.keep_clear
---what to keep away from, in the base frame
---@field center_m number[]
---how far away from it the axis should stay
---@field distance_m number
---of this wish against the others (else 1)
---@field weight? number

---@class arm.shape
---where nodes should be; an empty list clears them
---@field nodes arm.shape.nodes[]
---points that the arm's axis is pushed away from as far as the tip allows
---@field keep_clear? arm.shape.keep_clear[]
---the best of all shapes is looked for first (arm at rest) (else false)
---@field search? boolean

---Null-space targets of nodes, and points that the arm keeps away from. For cable arms only.
---@param fields arm.shape
---@return integer id
function arm.shape(fields) end

---@class arm.dither
---of every planned tension, up and down (else 0.3)
---@field share? number
---in which the share decays evenly to nothing (else 4)
---@field duration_s? number

---All tensions of an arm at rest go slowly up and down, which frees what friction holds. For cable arms only.
---@param fields? arm.dither
---@return integer id
function arm.dither(fields) end

---@class arm.use_device
---who steers: `vr`, `hand`, `pointer`, or a connected device by its name; `none`: nobody
---@field device string
---way of the tip for a way of the hand (else 1)
---@field scale? number
---turn of the tip for a turn of the hand (else 1)
---@field rotation_scale? number
---node that the left hand of `vr` moves; 0: none (else 0)
---@field node? integer
---fastest that the tip follows (else the robot's tip speed)
---@field speed_m_s? number
---`vr` steers inside the slit, too; else it is refused there, and let go at the mouth (else false)
---@field anywhere? boolean
---axes of the hand (not of `vr`'s left one): the base's (else), the tip's on engaging, the tip camera's,
---which turn
---@field frame? "base"|"tip"|"camera"
---names of the scene's fixtures that guide the hand and are felt; left out: all of them
---@field fixtures? string
---law by which the hand feels the arm; `aligned` when left out
---@field feedback? "aligned"|"claim"|"abstract"|"off"

---Who steers, and how hand motion maps to the tip. For cable arms only.
---@param fields arm.use_device
---@return integer id
function arm.use_device(fields) end

---@class arm.insert.gains
---M_d along the axes
---@field mass_kg? number
---M_d about the axes
---@field inertia_kgm2? number
---K_D along the axis of the insertion
---@field axial_damping_Ns_per_m? number
---K_D across it
---@field lateral_damping_Ns_per_m? number
---K_D of turning
---@field turn_damping_Nms_per_rad? number
---K_P C_F: of what is missing of the set force
---@field force_gain? number
---K_P of impedance
---@field stiffness_N_per_m? number
---K_P of impedance in turning
---@field turn_stiffness_Nm_per_rad? number
---impedance: of the point that it pulls to
---@field approach_m_s? number
---K_D along the axis from capture on
---@field unload_damping_Ns_per_m? number

---@class arm.insert
---way in, in the frame of the tip, of any length; left out: the tip's z
---@field axis? number[]
---set force along the axis; the other five are set to nothing (else 30)
---@field force_N? number
---the most along the axis, from where it begins (else 0.06)
---@field travel_m? number
---the most across it (else 0.02)
---@field lateral_m? number
---the most that the tip turns (else 3)
---@field turn_deg? number
---`force` when left out
---@field law? "force"|"impedance"
---`impedance`: where the stop is expected, along the axis (else 0.0222)
---@field depth_m? number
---what the wrist sensor says in the first 0.1 s is taken for nothing (else true)
---@field tare? boolean
---other gains than the robot's, within its ranges
---@field gains? arm.insert.gains

---Moves along an axis of the tip under force control, from rest, until something else is asked for; how it
---goes is `insert` of the state. For serial arms only.
---@param fields? arm.insert
---@return integer id
function arm.insert(fields) end

---From rest, joints give way to what pushes them with more than 20 N m, until something else is asked for.
---For serial arms only.
---@return integer id
function arm.comply() end

---@class arm.payload
---0: nothing
---@field mass_kg number
---centre of mass, in the frame of the tip; left out: the tip's origin
---@field center_m? number[]
---xx, yy, zz, xy, xz, yz about the centre of mass, along the axes of the tip's frame; all six. Left out of
---mass 0, and of cable arms, which take a payload as a point mass
---@field inertia_kgm2? number

---What the arm carries beside its tool from now on, until another is told. Drives that follow torques get
---what moving it takes; a cable arm, at rest, holds its weight by its tensions.
---@param fields arm.payload
---@return integer id
function arm.payload(fields) end

---@class arm.adapter
---what the adapter should do
---@field command "lock"|"release"

---Tells the adapter to lock or to release the payload; how it goes is `adapter` of the state. For serial arms
---only.
---@param fields arm.adapter
---@return integer id
function arm.adapter(fields) end

---@class arm.retract
---not farther back than the arm was then (else 0)
---@field until_tick? integer

---Stop, then back along the verified path, a little slower than the way in.
---@param fields? arm.retract
---@return integer id
function arm.retract(fields) end

---Stop along the path and stay enabled.
---@return integer id
function arm.hold() end

---@class arm.tool
---what the tool should do
---@field command string

---A command to the tool at the tip; how it goes is `tool` of the state.
---@param fields arm.tool
---@return integer id
function arm.tool(fields) end

---@class arm.stop
---why, shown by `state`: any JSON value, cut to 200 bytes
---@field reason? string

---Stop, brakes, disable; never refused.
---@param fields? arm.stop
---@return integer id
function arm.stop(fields) end

---@class arm.announce.step
---number of the step
---@field index integer
---what the step is called
---@field name string
---who steers
---@field device string
---what the operator should do
---@field task? string
---how many steps of the mission have begun, this one included
---@field entry? integer
---what the step waits for people for
---@field waits? string

---@class arm.announce
---the step that begins; null or left out: the mission has ended
---@field step? arm.announce.step
---the condition that ended the step before
---@field after? string

---Tells the operator which step runs.
---@param fields? arm.announce
---@return integer id
function arm.announce(fields) end

return arm
